// SPDX-License-Identifier: Apache-2.0
// Another engine than the default one, from the bench to the estimate: linearised, designed for, flown and estimated with
// the channels of its own file. And designs that are of another engine than the one that flies: no estimate comes of it.

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/integration/pair/pair.h"
#include "tests/temporary_folder.h"

namespace {

using namespace ehm;
using namespace ehm::test;
using Json = nlohmann::json;
using testing::HasSubstr;

class AnotherEngineTest : public PairTest {
 protected:
  static void run(const std::vector<std::string>& arguments) {
    Process process(arguments);
    ASSERT_EQ(process.wait(seconds(90)), 0) << process.log();
  }
  /// Of a shipped engine at cruise, by the two commands of the bench.
  std::string design_of(const std::string& engine) const {
    const std::string model = folder_.path("model.json"), design = folder_.path("design.json");
    run({EHM_TUNER_DESIGN, "linearise", "--engine", engine, "--method", "fleet", "--out", model});
    run({EHM_TUNER_DESIGN, "design", "--model", model, "--out", design});
    return design;
  }
  std::unique_ptr<Process> monitor_of(const std::string& design) const {
    return std::make_unique<Process>(std::vector<std::string>{monitor_program(), "--dds-domain",
                                                              std::to_string(domain_), "--monitor-design", design,
                                                              "--monitor-clock", "source"});
  }
  /// At cruise with two parameters worn, ten times real time: the listener must see every sample, and lockstep waits for
  /// the monitor only.
  std::unique_ptr<Process> fly(const std::string& engine, const std::string& duration_s) {
    const std::string scenario = folder_.file("scenario.toml",
                                              "[flight]\naltitude_m = 10668.0\nmach = 0.8\n"
                                              "[demand]\nkind = \"t40_k\"\nvalue = 1308.6\n"
                                              "[[wear]]\nparameter = \"hpc_efficiency\"\ninitial = -0.015\n"
                                              "[[wear]]\nparameter = \"hpt_flow\"\ninitial = 0.009\n");
    // The simulator waits for readers of its own samples; that we hear the estimates is for us to await.
    EXPECT_TRUE(listener_.await([&] { return listener_.monitors() == 1; }));
    return start_simulator({"--engine", engine, "--run-duration-s", duration_s, "--run-rate", "10"}, scenario);
  }
  const EngineDescription* description(idl::DescriptionRole role) const {
    for (const EngineDescription& d : listener_.descriptions)
      if (d.role() == static_cast<std::uint32_t>(role)) return &d;
    return nullptr;
  }
  TemporaryFolder folder_;
};

/// Largest |estimate - truth| over the published sigma.
double worst(std::uint32_t count, const auto& estimate, const auto& truth, const auto& sigma) {
  double largest = 0.0;
  for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, std::abs(estimate[i] - truth[i]) / sigma[i]);
  return largest;
}

TEST_F(AnotherEngineTest, IsLinearisedDesignedForFlownAndEstimated) {
  const auto monitor = monitor_of(design_of("high_bypass"));
  const auto simulator = fly("high_bypass", "30");
  constexpr std::size_t sent = 2000, settled = 667;  // of 15 ms; from 10 s on, four of the filter's time constants
  ASSERT_TRUE(listener_.await(
      [&] {
        return listener_.health.size() == sent && listener_.auxiliary.size() == sent && listener_.truth.size() == sent;
      },
      seconds(60)))
      << listener_.health.size() << monitor->log() << simulator->log();

  double health = 0.0, auxiliary = 0.0;
  for (std::size_t k = settled; k < sent; ++k) {
    const EngineHealth& h = listener_.health[k];
    const EngineAuxiliary& z = listener_.auxiliary[k];
    const EngineTruth &true_h = listener_.truth.at(h.sequence_number()),
                      &true_z = listener_.truth.at(z.sequence_number());
    health = std::max(health, worst(h.health_count(), h.health(), true_h.health(), h.sigma_total()));
    auxiliary = std::max(auxiliary, worst(z.auxiliary_count(), z.auxiliary(), true_z.auxiliary(), z.sigma_total()));
  }
  std::printf("worst error from 10 s on: health %.2f, auxiliary %.2f published sigmas\n", health, auxiliary);
  EXPECT_GT(health, 0.0);
  EXPECT_LT(health, 4.0);
  EXPECT_GT(auxiliary, 0.0);
  EXPECT_LT(auxiliary, 4.0);
  // What is worn is told from a new engine.
  const EngineHealth& last = listener_.health.back();
  EXPECT_LT(last.health()[4], -3.0 * last.sigma_total()[4]) << "hpc_efficiency, true -1.5 %";
  EXPECT_GT(last.health()[7], 3.0 * last.sigma_total()[7]) << "hpt_flow, true 0.9 %";

  // The channels are those of its file, not the default engine's.
  const EngineDescription *source = description(idl::DescriptionRole::source),
                          *estimate = description(idl::DescriptionRole::monitor);
  ASSERT_TRUE(source != nullptr && estimate != nullptr);
  EXPECT_STREQ(source->engine_type().c_str(), "high-bypass-turbofan");
  EXPECT_STREQ(estimate->engine_type().c_str(), "high-bypass-turbofan");
  ASSERT_EQ(estimate->sensor_count(), 8u);
  EXPECT_STREQ(estimate->sensors()[5].name().c_str(), "Ps30");
  ASSERT_EQ(estimate->auxiliary_count(), 5u);
  EXPECT_STREQ(estimate->auxiliary()[4].name().c_str(), "EGTM");
  for (const auto kind : {idl::EventKind::source_channels, idl::EventKind::sensor_fault, idl::EventKind::health_shift,
                          idl::EventKind::unlikely_engine})
    EXPECT_FALSE(listener_.has_event(kind, true)) << static_cast<int>(kind);
}

TEST_F(AnotherEngineTest, OtherChannelsThanTheDesignsLeadToNoEstimate) {
  const auto monitor = monitor_of(design_file());
  const auto simulator = start_simulator({"--engine", "high_bypass", "--run-duration-s", "2"});
  ASSERT_TRUE(listener_.await([&] { return !listener_.truth.empty() && !simulator->running(); }, seconds(40)));
  EXPECT_TRUE(listener_.health.empty());
  EXPECT_THAT(
      monitor->log(),
      HasSubstr("engine 1: a sample of source 1 cannot be used: schema 1 with 8 sensors and 5 actuators; needed "
                "are schema 1, 7 sensors and 5 actuators"));
}

TEST_F(AnotherEngineTest, WithTheDesignsChannelsIsNamedAndFarFromItsPoint) {
  const auto shipped = [](const std::string& name) {
    return Json::parse(std::ifstream(EHM_SOURCE_DIR "/deploy/engines/" + name + ".json"));
  };
  Json engine = shipped("high_bypass");
  engine["channels"] = shipped("jt9d")["channels"];
  const auto monitor = monitor_of(design_file());
  const auto simulator =
      start_simulator({"--engine", folder_.file("engine.json", engine.dump()), "--run-duration-s", "2"});
  ASSERT_TRUE(listener_.await([&] { return listener_.has_event(idl::EventKind::operating_point, true); }, seconds(40)))
      << monitor->log();
  ASSERT_TRUE(listener_.await([&] { return !simulator->running(); }));
  EXPECT_GT(listener_.find_event(idl::EventKind::operating_point, true)->value(), 2.0);
  ASSERT_TRUE(listener_.await([&] { return listener_.has_event(idl::EventKind::source_channels, true); }));
  EXPECT_THAT(std::string(listener_.find_event(idl::EventKind::source_channels, true)->message().c_str()),
              HasSubstr("the engine is high-bypass-turbofan by source 1, jt9d by the design"));
  EXPECT_TRUE(listener_.health.empty());
}

}  // namespace
