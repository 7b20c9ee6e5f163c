// SPDX-License-Identifier: Apache-2.0
// The linear model file: refused with a FileError, or a model that is written and read back as the same.

#include "deploy/runtime/files/file_error.h"
#include "engine_sim/linear_model/model_file.h"
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ehm;
  const fuzz::MemoryFile file(data, size);
  try {
    const linear_model::LinearModel model = linear_model::read_model(file.path());
    EHM_REQUIRE(model.A.allFinite() && model.C.allFinite() && model.M.allFinite());
    EHM_REQUIRE((model.sensor_noise_sigma.array() > 0.0).all());
    EHM_REQUIRE(model.sample_time_s > 0.0);
  } catch (const files::FileError& e) {
    EHM_REQUIRE(e.what()[0] != '\0');
  }
  return 0;
}
