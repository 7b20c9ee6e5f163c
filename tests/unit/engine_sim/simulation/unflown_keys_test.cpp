// SPDX-License-Identifier: Apache-2.0
// A replay names what of a scenario it does not use.

#include "engine_sim/replay/unflown_keys.h"

#include <gtest/gtest.h>

#include "deploy/runtime/config/schema.h"
#include "engine_sim/scenario/scenario_file.h"
#include "tests/unit/deploy/runtime/config/config_file.h"

namespace ehm::engine_sim {
namespace {

std::string unflown_of(const std::string& toml) {
  SimConfig config;
  config::Schema schema;
  declare(schema, config);
  const test::ConfigFile file(toml);
  schema.load(file.path());
  return unflown_keys(schema.given());
}

TEST(UnflownKeys, WhereAndHowFastIsForAReplayToo) {
  EXPECT_EQ(unflown_of("[dds]\ndomain = 3\n[log]\nlevel = \"warn\"\n[replay]\nfile = \"x.h5\"\n"
                       "[run]\nrate = \"max\"\nlockstep_window = 2\nwait_for_monitors = 1\n"),
            "");
}

TEST(UnflownKeys, TheEngineItsWearAndItsNoiseAreInTheRecordingAlready) {
  EXPECT_EQ(unflown_of("[mismatch]\nbuild = true\nseed = 2\n[process_noise]\nspeed_sigma_percent = 0.1\n"
                       "[[wear]]\nparameter = \"fan_flow\"\ninitial = -0.01\n[dds]\ndomain = 3\n"),
            "'mismatch.build', 'mismatch.seed', 'process_noise.speed_sigma_percent', 'wear'");
}

}  // namespace
}  // namespace ehm::engine_sim
