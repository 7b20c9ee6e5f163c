// SPDX-License-Identifier: Apache-2.0
// A checkpoint: refused with a FileError, or plain data that a cycle may be asked to resume from.

#include "deploy/runtime/files/file_error.h"
#include "monitor/checkpoint/checkpoint.h"
#include "tests/fuzz/require.h"
#include "tests/fuzz/sealed_json.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const auto checkpoint = ehm::monitor::parse_checkpoint(ehm::fuzz::sealed(data, size), "fuzz.json");
    EHM_REQUIRE(checkpoint.state.watch.estimate.allFinite());
    for (const auto& companion : checkpoint.state.companions) EHM_REQUIRE(companion.state.estimate.allFinite());
  } catch (const ehm::files::FileError& e) {
    EHM_REQUIRE(e.what()[0] != '\0');
  }
  return 0;
}
