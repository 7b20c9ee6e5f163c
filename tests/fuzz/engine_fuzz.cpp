// SPDX-License-Identifier: Apache-2.0
// The engine file: refused with a FileError, or an engine that is written and read back as the same, with maps that give
// finite numbers.

#include <cmath>

#include "deploy/runtime/files/file_error.h"
#include "engine_sim/engines/engine_file.h"
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ehm;
  const fuzz::MemoryFile file(data, size);
  try {
    const engine_sim::EngineDefinition engine = engine_sim::read_engine(file.path());
    const std::string text = engine_sim::engine_text(engine);
    EHM_REQUIRE(engine_sim::engine_text(engine_sim::engine_from_text(text, "again")) == text);
    EHM_REQUIRE(std::isfinite(engine.data.fan.map.at(0.9, 2.0).flow));
    EHM_REQUIRE(std::isfinite(engine.data.hpt.map.at(100.0, 4.0).flow));
    EHM_REQUIRE(!engine.channels.sensors.empty() && engine.channels.sensors.size() <= 16);
  } catch (const files::FileError& e) {
    EHM_REQUIRE(e.what()[0] != '\0');
  }
  return 0;
}
