// SPDX-License-Identifier: Apache-2.0
// The monitor's configuration file: refused with a ConfigError, or every value is in its range and prints.

#include "monitor/service/config.h"
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ehm;
  const fuzz::MemoryFile file(data, size);
  monitor::MonitorConfig config;
  config::Schema schema;
  monitor::declare(schema, config);
  try {
    schema.load(file.path());
    monitor::finish_config(config);
  } catch (const config::ConfigError& e) {
    EHM_REQUIRE(e.what()[0] != '\0');
    return 0;
  }
  EHM_REQUIRE(config.max_engines >= 1 && config.max_engines <= 1000);
  EHM_REQUIRE(config.cycle.checks.gate_sigma >= 2.0 && config.cycle.checks.gate_sigma <= 20.0);
  EHM_REQUIRE(config.domain >= 0 && config.domain <= 232);
  for (const auto& limit : config.cycle.limits) EHM_REQUIRE(limit.min < limit.max);
  EHM_REQUIRE(!schema.reference().empty());
  return 0;
}
