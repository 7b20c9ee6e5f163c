// SPDX-License-Identifier: Apache-2.0
// The keys [process_noise] and the tables [[health_noise]]: what they make of a scenario, and what is refused.

#include <gmock/gmock.h>

#include "deploy/runtime/files/table_text.h"
#include "engine_sim/engines/engine_file.h"
#include "engine_sim/engines/jt9d_engine.h"
#include "engine_sim/scenario/scenario_file.h"
#include "tests/temporary_folder.h"
#include "tests/unit/deploy/runtime/config/config_file.h"

namespace {

using namespace ehm;
using engine_sim::ProcessNoise;
using testing::EndsWith;
using testing::HasSubstr;

class ProcessNoiseKeysTest : public testing::Test {
 protected:
  ProcessNoise load(const std::string& toml) {
    engine_sim::SimConfig config;
    config::Schema schema;
    engine_sim::declare(schema, config);
    schema.load(folder_.file("scenario.toml", toml));
    engine_sim::finish_config(config, schema);
    return config.scenario.process_noise;
  }
  std::string error(const std::string& toml) {
    return test::message_of<config::ConfigError>([&] { load(toml); });
  }
  test::TemporaryFolder folder_;
};

TEST_F(ProcessNoiseKeysTest, WithoutKeysItIsOff) {
  EXPECT_FALSE(load("").on());
  EXPECT_FALSE(load("[process_noise]\ndistribution = \"none\"\nhealth_sigma = 5e-4\n").on());  // a way to switch it off
}

TEST_F(ProcessNoiseKeysTest, OneSigmaIsOfAllParametersButForThoseThatATableNames) {
  const ProcessNoise noise = load(
      "[process_noise]\ndistribution = \"rayleigh_shifted\"\nhealth_sigma = 5e-4\nspeed_sigma_percent = 0.01\n"
      "accumulate = true\n[[health_noise]]\nparameter = \"hpc_flow\"\nsigma = 1e-3\n");
  EXPECT_EQ(noise.distribution, NoiseDistribution::rayleigh_shifted);
  EXPECT_EQ(noise.speed_sigma_percent, 0.01);
  EXPECT_TRUE(noise.accumulate);
  ASSERT_EQ(noise.health_sigma.size(), engine_sim::health_count);
  for (std::size_t j = 0; j < engine_sim::health_count; ++j)
    EXPECT_EQ(noise.health_sigma[j], j == engine_sim::hpc_flow ? 1e-3 : 5e-4) << j;
}

TEST_F(ProcessNoiseKeysTest, ATableAloneMovesItsParameterAlone) {
  const ProcessNoise noise =
      load("[process_noise]\ndistribution = \"gaussian\"\n[[health_noise]]\nparameter = \"hpt_flow\"\nsigma = 2e-3\n");
  EXPECT_EQ(noise.health_sigma.at(engine_sim::hpt_flow), 2e-3);
  EXPECT_EQ(noise.health_sigma.at(engine_sim::hpc_flow), 0.0);
}

TEST_F(ProcessNoiseKeysTest, WhatTheTruthOfAnEngineDoesNotShowIsNotMovedUnlessItIsNamed) {
  engine_sim::EngineDefinition few = engine_sim::jt9d_engine();
  std::erase_if(few.channels.health, [](const auto& channel) {
    return channel.parameter == engine_sim::lpc_flow || channel.parameter == engine_sim::lpt_flow;
  });
  const std::string head = "[engine]\nmodel = \"" + folder_.file("few.json", engine_sim::engine_text(few)) +
                           "\"\n[process_noise]\ndistribution = \"gaussian\"\nhealth_sigma = 5e-4\n";
  const ProcessNoise noise = load(head + "[[health_noise]]\nparameter = \"lpt_flow\"\nsigma = 1e-3\n");
  EXPECT_EQ(noise.health_sigma.at(engine_sim::lpc_flow), 0.0);
  EXPECT_EQ(noise.health_sigma.at(engine_sim::lpt_flow), 1e-3);
  EXPECT_EQ(noise.health_sigma.at(engine_sim::hpc_flow), 5e-4);
}

TEST_F(ProcessNoiseKeysTest, EveryMistakeIsOneMessageWithItsRemedy) {
  const std::string on = "[process_noise]\ndistribution = \"gaussian\"\n";
  EXPECT_THAT(error("[process_noise]\ndistribution = \"normal\"\n"),
              EndsWith("scenario.toml:2: 'process_noise.distribution' is 'normal', allowed is one of none, gaussian, "
                       "rayleigh, rayleigh_shifted"));
  EXPECT_THAT(error(on + "health_sigma = 0.05\n"),
              EndsWith("'process_noise.health_sigma' is 0.05, allowed is a number from 0 to 0.01 fraction"));
  EXPECT_THAT(error(on + "speed_sigma_percent = -1\n"), HasSubstr("allowed is a number from 0 to 0.1 percent"));
  EXPECT_THAT(error(on + "helth_sigma = 1e-3\n"), HasSubstr("did you mean 'process_noise.health_sigma'?"));
  EXPECT_THAT(error(on), HasSubstr("'process_noise.distribution' is 'gaussian', but no size is given"));
  EXPECT_EQ(
      error("[process_noise]\nhealth_sigma = 5e-4\n"),
      "'process_noise.health_sigma' is given, but not 'process_noise.distribution': set it to gaussian, rayleigh or "
      "rayleigh_shifted");
  EXPECT_THAT(error("[[health_noise]]\nparameter = \"hpc_flow\"\nsigma = 1e-3\n"),
              HasSubstr("'health_noise' is given"));
  EXPECT_THAT(error(on + "accumulate = true\nspeed_sigma_percent = 0.01\n"), HasSubstr("but health has no noise"));
  EXPECT_THAT(error("[process_noise]\ndistribution = \"rayleigh\"\nhealth_sigma = 5e-4\naccumulate = true\n"),
              HasSubstr("set rayleigh_shifted, and a drift by 'wear.drift_per_hour'"));
}

TEST_F(ProcessNoiseKeysTest, TablesAreAsStrictAsTheOthers) {
  const std::string on = "[process_noise]\ndistribution = \"gaussian\"\n[[health_noise]]\n";
  EXPECT_THAT(error(on + "parameter = \"hpc\"\nsigma = 1e-3\n"),
              HasSubstr("'health_noise.parameter' is 'hpc', allowed"));
  EXPECT_THAT(error(on + "parameter = \"hpc_flow\"\nsigma = 0.02\n"),
              EndsWith("'health_noise.sigma' is 0.02, allowed is a number from 0 to 0.01"));
  EXPECT_THAT(error(on + "parameter = \"hpc_flow\"\n"), HasSubstr("health_noise.sigma"));
  EXPECT_THAT(error(on + "parameter = \"hpc_flow\"\nsigma = 1e-3\nmean = 1\n"), HasSubstr("mean"));
}

TEST_F(ProcessNoiseKeysTest, TheExampleIsAScenarioWithNoise) {
  const ProcessNoise noise =
      load(files::read_text(std::string(EHM_SOURCE_DIR) + "/deploy/config_examples/process_noise.toml"));
  EXPECT_EQ(noise.distribution, NoiseDistribution::rayleigh_shifted);
  EXPECT_EQ(noise.health_sigma.at(engine_sim::fan_flow), 5e-4);
  EXPECT_EQ(noise.health_sigma.at(engine_sim::hpt_flow), 1e-3);
}

}  // namespace
