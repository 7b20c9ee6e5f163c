// SPDX-License-Identifier: Apache-2.0
// engine_sim's configuration with a linear model: tables speak of its channels, what it cannot fly is refused.

#include <gmock/gmock.h>

#include <CLI/App.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "engine_sim/linear_model/model_file.h"
#include "engine_sim/scenario/scenario_file.h"
#include "tests/temporary_folder.h"
#include "tests/unit/deploy/runtime/config/config_file.h"
#include "tests/unit/tuner_design/test_models.h"

namespace {

using namespace ehm;
using testing::EndsWith;
using testing::HasSubstr;

class LinearConfig : public testing::Test {
 protected:
  LinearConfig() {
    linear_model::LinearModel model = test::made_up_model();
    model.health[1].trim = -0.01;
    model.health[5].unit = "percent";
    model.sample_time_s = 0.02;
    linear_model::write_model(model, model_);
  }
  engine_sim::SimConfig load(const std::string& toml) {
    engine_sim::SimConfig config;
    config::Schema schema;
    engine_sim::declare(schema, config);
    schema.load(folder_.file("scenario.toml", "[linear]\nmodel = \"" + model_ + "\"\n" + toml));
    engine_sim::finish_config(config, schema);
    return config;
  }
  std::string error(const std::string& toml) {
    return test::message_of<config::ConfigError>([&] { load(toml); });
  }
  test::TemporaryFolder folder_;
  std::string model_ = folder_.path("model.json");
};

TEST_F(LinearConfig, TablesSpeakOfTheModelsChannelsInItsUnits) {
  const auto config = load(R"(
[[wear]]
parameter = "h5"
initial = -12
drift_per_hour = -36
[[health_change]]
time_s = 5
parameter = "h0"
change = -0.02
[[control_change]]
time_s = 7
control = "Wf"
change = 0.01
ramp_s = 2
[[sensor_fault]]
time_s = 9
sensor = "N2"
kind = "dropout"
)");
  ASSERT_NE(config.linear, nullptr);
  const engine_sim::Scenario& s = config.scenario;
  ASSERT_EQ(s.wear.size(), 6u);
  EXPECT_DOUBLE_EQ(s.wear[1].initial, -0.01);  // the model's trim
  EXPECT_DOUBLE_EQ(s.wear[5].initial, -12.0);
  EXPECT_DOUBLE_EQ(s.wear[5].drift_per_s, -0.01);
  EXPECT_EQ(s.health_changes.at(0).channel, 0u);
  EXPECT_EQ(s.control_changes.at(0).channel, 0u);
  EXPECT_DOUBLE_EQ(s.control_changes.at(0).ramp_s, 2.0);
  EXPECT_EQ(s.faults.at(0).sensor, 1u);
}

TEST_F(LinearConfig, ProcessNoiseOfHealthIsInTheModelsUnits) {
  const std::string on = "[process_noise]\ndistribution = \"gaussian\"\nhealth_sigma = 5e-4\n";
  const auto noise = load(on + "[[health_noise]]\nparameter = \"h1\"\nsigma = 1e-3\n").scenario.process_noise;
  const std::vector<double> expected{5e-4, 1e-3, 5e-4, 5e-4, 5e-4, 0.05};  // h5 is in percent
  ASSERT_EQ(noise.health_sigma.size(), expected.size());
  for (std::size_t j = 0; j < expected.size(); ++j) EXPECT_DOUBLE_EQ(noise.health_sigma[j], expected[j]) << j;
  EXPECT_EQ(error(on + "[[health_noise]]\nparameter = \"h5\"\nsigma = 0.9\n"), "");
  EXPECT_THAT(error(on + "[[health_noise]]\nparameter = \"h5\"\nsigma = 1.1\n"), HasSubstr("from 0 to 1"));
}

TEST_F(LinearConfig, TheModelIsKnownToTheTablesHoweverItIsNamed) {
  engine_sim::SimConfig config;
  config::Schema schema;
  engine_sim::declare(schema, config);
  CLI::App app;
  schema.add_flags(app);
  app.parse("--linear " + model_);
  schema.load(folder_.file("scenario.toml", "[[wear]]\nparameter = \"h0\"\ninitial = -0.01\n"));
  engine_sim::finish_config(config, schema);
  EXPECT_DOUBLE_EQ(config.scenario.wear.at(0).initial, -0.01);
}

TEST_F(LinearConfig, AnotherEnginesNamesAreRefusedWithTheOnesThatThereAre) {
  EXPECT_THAT(error("[[wear]]\nparameter = \"hpc_flow\"\n"),
              EndsWith("'wear.parameter' is 'hpc_flow', allowed is one of h0, h1, h2, h3, h4, h5"));
  EXPECT_THAT(error("[[sensor_fault]]\ntime_s = 1\nsensor = \"T30\"\nkind = \"stuck\"\n"),
              EndsWith("'sensor_fault.sensor' is 'T30', allowed is one of N1, N2, y2, y3"));
  EXPECT_THAT(error("[[wear]]\nparameter = \"h0\"\ninitial = -12\n"),
              EndsWith("'wear.initial' is -12, allowed is a number from -0.3 to 0.1"));
  EXPECT_THAT(error("[[health_change]]\ntime_s = 0\nparameter = \"h5\"\nchange = 8\n"
                    "[[health_change]]\ntime_s = 1\nparameter = \"h5\"\nchange = 8\n"),
              EndsWith("'health_change' brings h5 to 16 at 1 s, allowed is -30 to 10"));
}

TEST_F(LinearConfig, WhatALinearModelCannotFlyIsRefusedWithTheReason) {
  const std::pair<const char*, const char*> refused[] = {
      {"[flight]\nmach = 0.8\n",
       "'flight.mach' is given, but 'linear.model' flies a linear model, which holds at its own"},
      {"[demand]\nvalue = 1308.6\n", "'demand.value' is given"},  // though that is the default
      {"[aircraft]\npower_w = 1\n", "which has no offtakes"},
      {"[control]\nhold_limits = false\n", "whose controls stay at their trims"},
      {"[sensors]\nnoise_speed_percent = 1\n", "'sensors.noise_speed_percent' is given"},
      {"[engine]\nheat_soak = true\n", "'engine.heat_soak' is given"},
      {"[run]\nsample_time_s = 0.02\n", "which has a sample_time_s of its own"},
      {"[process_noise]\ndistribution = \"gaussian\"\nspeed_sigma_percent = 0.01\n",
       "whose states move by the process_noise that it states"},
      {"[replay]\nfile = \"x.h5\"\n", "'replay.file' is given"},
      {"[[profile]]\ntime_s = 0\nn1_rpm = 3000\n", "'profile' is given"}};
  for (const auto& [toml, message] : refused) EXPECT_THAT(error(toml), HasSubstr(message)) << toml;
  EXPECT_EQ(error("[run]\nseed = 7\nduration_s = 5\n[engine]\nid = 3\n"), "");
}

TEST_F(LinearConfig, AModelWithAnErrorNamesFileAndKey) {
  auto json = nlohmann::json::parse(std::ifstream(model_));
  json["sensors"][1]["noise_sigma"] = -1.0;
  std::ofstream(model_) << json;
  EXPECT_THAT(error(""), HasSubstr("'linear.model': " + model_ + ": sensors[1].noise_sigma is -1.0"));
  json["sensors"][1]["noise_sigma"] = 1.0;
  json["A"][0][0] = 1.5;
  std::ofstream(model_) << json;
  EXPECT_THAT(error(""), HasSubstr(model_ + ": A is unstable"));
  model_ = folder_.path("nowhere.json");
  EXPECT_THAT(error(""), HasSubstr("'linear.model': " + model_ + ": no such file"));
}

TEST(ScenarioFile, AControlChangeNeedsALinearModel) {
  const test::ConfigFile file("[[control_change]]\ntime_s = 0\ncontrol = \"fuel_flow\"\nchange = 1\n");
  engine_sim::SimConfig config;
  config::Schema schema;
  engine_sim::declare(schema, config);
  EXPECT_THAT(test::message_of<config::ConfigError>([&] { schema.load(file.path()); }),
              HasSubstr("'control_change' is for a linear model"));
}

}  // namespace
