// SPDX-License-Identifier: Apache-2.0
// The simulator's scenario file: refused with a ConfigError, or every value is in its range.

#include "engine_sim/scenario/scenario_file.h"
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ehm;
  const fuzz::MemoryFile file(data, size);
  engine_sim::SimConfig config;
  config::Schema schema;
  engine_sim::declare(schema, config);
  try {
    schema.load(file.path());
    engine_sim::finish_config(config, schema);
  } catch (const config::ConfigError& e) {
    EHM_REQUIRE(e.what()[0] != '\0');
    return 0;
  }
  EHM_REQUIRE(config.rate_factor() >= 0.0);
  EHM_REQUIRE(config.domain >= 0 && config.domain <= 232);
  EHM_REQUIRE(!schema.reference().empty());
  return 0;
}
