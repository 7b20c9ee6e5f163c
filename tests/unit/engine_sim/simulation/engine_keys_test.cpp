// SPDX-License-Identifier: Apache-2.0
// engine_sim's configuration with another engine than the default: what is not given is the engine's own.

#include <gmock/gmock.h>

#include "engine_sim/engines/engine_file.h"
#include "engine_sim/engines/jt9d_engine.h"
#include "engine_sim/engines/shipped_engines.h"
#include "engine_sim/scenario/scenario_file.h"
#include "engine_sim/simulation.h"
#include "tests/temporary_folder.h"
#include "tests/unit/deploy/runtime/config/config_file.h"

namespace {

using namespace ehm;
using testing::HasSubstr;

class EngineKeysTest : public testing::Test {
 protected:
  engine_sim::Scenario load(const std::string& toml) {
    engine_sim::SimConfig config;
    config::Schema schema;
    engine_sim::declare(schema, config);
    schema.load(folder_.file("scenario.toml", toml));
    engine_sim::finish_config(config, schema);
    return config.scenario;
  }
  std::string error(const std::string& toml) {
    return test::message_of<config::ConfigError>([&] { load(toml); });
  }
  test::TemporaryFolder folder_;
};

TEST_F(EngineKeysTest, WithoutANameTheDefaultEngineFlies) {
  const engine_sim::Scenario s = load("");
  EXPECT_EQ(s.engine.get(), &engine_sim::jt9d_engine());
  EXPECT_EQ(s.control.limits.n1_rpm, 4070.0);
  EXPECT_FALSE(s.sensors.noise_speed_percent);
}

TEST_F(EngineKeysTest, WhatIsNotGivenIsTheEnginesOwn) {
  const engine_sim::Scenario s = load(
      "[engine]\nmodel = \"high_bypass\"\n[control]\nn1_max_rpm = 4500\nhold_limits = false\n"
      "[sensors]\nlag_temperature_s = 0.7\n");
  EXPECT_EQ(s.engine->data.name, "high-bypass turbofan");
  EXPECT_EQ(s.control.limits.n1_rpm, 4500.0);
  EXPECT_EQ(s.control.limits.n2_rpm, 15400.0);  // its rating, not the JT9D's 8400
  EXPECT_FALSE(s.control.hold_limits);
  EXPECT_EQ(s.control.fuel.acceleration.size(), s.engine->control.fuel.acceleration.size());
  EXPECT_EQ(s.sensors.lag_temperature_s, 0.7);
  EXPECT_FALSE(s.sensors.noise_temperature_percent);
}

// The first part of the power lever's way does nothing: there the idle loop decides, on the ground and aloft.
TEST_F(EngineKeysTest, APowerLeverAtZeroIsIdleForEveryShippedEngine) {
  for (const char* engine : {"jt9d", "high_bypass"}) {
    for (const char* flight : {"altitude_m = 0\nmach = 0\n", "altitude_m = 6000\nmach = 0.6\n"}) {
      SCOPED_TRACE(std::string(engine) + ", " + flight);
      const auto core_speed_at = [&](const char* percent) {
        engine_sim::Simulation simulation(load(std::string("[engine]\nmodel = \"") + engine + "\"\n[flight]\n" +
                                               flight + "[demand]\nkind = \"power_lever_percent\"\nvalue = 60\n" +
                                               "[[profile]]\ntime_s = 0\npower_lever_percent = 60\n" +
                                               "[[profile]]\ntime_s = 1\npower_lever_percent = " + percent + "\n"));
        while (simulation.time_s() < 40.0) simulation.next();
        const engine_sim::SimSample sample = simulation.next();
        return sample.readings[1].value;  // Nc
      };
      const double zero = core_speed_at("0"), little = core_speed_at("3"), most = core_speed_at("85");
      EXPECT_NEAR(zero / little, 1.0, 0.01);  // noise 0.25 %
      EXPECT_GT(most, 1.03 * zero);
    }
  }
}

TEST_F(EngineKeysTest, TablesSpeakOfItsChannels) {
  const std::string fault = "[[sensor_fault]]\ntime_s = 1\nsensor = \"P13\"\nkind = \"dropout\"\n";
  EXPECT_EQ(load("[engine]\nmodel = \"high_bypass\"\n" + fault).faults.at(0).sensor, 2u);
  EXPECT_THAT(error(fault), HasSubstr("Nf, Nc, P24, T24, Ps30, T30, T48"));
}

// The table of life.h: LPC flow -1.01 % new and -2.08 % after 3000 flights, a washing gives back half of the difference.
TEST_F(EngineKeysTest, ALifeAddsToTheWearThatIsStated) {
  const std::string wear = "[[wear]]\nparameter = \"lpc_flow\"\ninitial = -0.01\n";
  EXPECT_NEAR(load("[life]\ncycles = 3000\n" + wear).wear[engine_sim::lpc_flow].initial, -0.0308, 1e-12);
  EXPECT_NEAR(load("[life]\ncycles = 3000\nwashed_at = 3000\n").wear[engine_sim::lpc_flow].initial, -0.01545, 1e-12);
  EXPECT_EQ(load("").wear[engine_sim::lpc_flow].initial, 0.0);
  EXPECT_THAT(error("[life]\ncycles = 100\nwashed_at = 200\n"), HasSubstr("allowed is up to life.cycles, 100"));
  EXPECT_THAT(error("[life]\nwashed_at = 200\n"), HasSubstr("go with 'life.cycles'"));
  EXPECT_THAT(error("[life]\ncycles = 6000\n[[wear]]\nparameter = \"hpc_flow\"\ninitial = -0.28\n"),
              HasSubstr("'wear' and 'life' bring hpc_flow to -0.33"));
}

TEST_F(EngineKeysTest, AMissionIsOneThing) {
  EXPECT_THAT(error("[mission]\nname = \"two_hours\"\nfile = \"f.csv\"\n"),
              testing::AllOf(HasSubstr("'mission.file' is 'f.csv'"), HasSubstr("leave one of the two out")));
  EXPECT_NEAR(load("[mission]\nname = \"two_hours\"\ntime_scale = 0.1\n").duration_s, 720.0, 1e-9);
}

TEST_F(EngineKeysTest, AFileIsReadAndItsDefectsAreTold) {
  const std::string file = folder_.file("mine.json", engine_sim::engine_text(engine_sim::jt9d_engine()));
  const engine_sim::Scenario s = load("[engine]\nmodel = \"" + file + "\"\n");
  EXPECT_EQ(engine_sim::engine_hash(*s.engine), engine_sim::engine_hash(engine_sim::jt9d_engine()));
  const std::string bad = folder_.file("bad.json", "{\"schema\": \"ehm-engine/1\"}");
  EXPECT_EQ(error("[engine]\nmodel = \"" + bad + "\"\n"), "'engine.model': " + bad + ": key name is missing. Add it.");
  EXPECT_THAT(error("[engine]\nmodel = \"jt8d\"\n"),
              HasSubstr("'engine.model': no engine is named 'jt8d'; allowed: jt9d, high_bypass, or an engine file"));
}

}  // namespace
