// SPDX-License-Identifier: Apache-2.0
// Engines that are known as matrices only, flown by engine_sim --linear: the cruise model, one without controls, one with
// two probes of the same quantity, and one whose design changes its units in flight.

#include <gmock/gmock.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/integration/pair/pair.h"
#include "tests/temporary_folder.h"

namespace {

using namespace ehm;
using namespace ehm::test;
using Json = nlohmann::json;
using testing::HasSubstr;

class OwnEngineTest : public PairTest {
 protected:
  static Json cruise_model() { return Json::parse(std::ifstream(EHM_MODEL_FILE)); }
  std::string write(const std::string& name, const Json& json) { return folder_.file(name, json.dump()); }
  std::string design(const std::string& model_file, const std::string& name) {
    const std::string out = folder_.path(name);
    Process process({EHM_TUNER_DESIGN, "design", "--model", model_file, "--out", out});
    EXPECT_EQ(process.wait(seconds(60)), 0) << process.log();
    return out;
  }
  void start(const std::vector<std::string>& flags) {
    std::vector<std::string> arguments{monitor_program(), "--dds-domain", std::to_string(domain_),
                                       "--monitor-status-period-s", "0.1"};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    monitor_ = std::make_unique<Process>(arguments);
    ASSERT_TRUE(listener_.await([&] { return listener_.monitors() == 1; })) << monitor_->log();
  }
  /// The model as the engine; begins once monitor and listener hear it.
  std::unique_ptr<Process> fly(const std::string& model_file, const std::vector<std::string>& flags) {
    std::vector<std::string> arguments{
        simulator_program(),       "--linear", model_file, "--dds-domain", std::to_string(domain_),
        "--run-wait-for-monitors", "2"};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    return std::make_unique<Process>(arguments);
  }
  bool await_end(Process& process) {
    return listener_.await([&] { return !process.running(); }, seconds(40)) && process.wait(seconds(1)) == 0;
  }
  TemporaryFolder folder_;
  std::unique_ptr<Process> monitor_;
};

TEST_F(OwnEngineTest, IsEstimatedWithinItsSigmaAndItsSensorFaultIsNamed) {
  const std::string model = write("model.json", cruise_model());
  start({"--monitor-design", design(model, "design.json"), "--monitor-clock", "source"});
  const std::string scenario = folder_.file("scenario.toml",
                                            "[[wear]]\nparameter = \"hpc_efficiency\"\ninitial = -0.02\n"
                                            "[[sensor_fault]]\nsensor = \"T30\"\nkind = \"bias\"\n"
                                            "magnitude = 60\ntime_s = 60\n");
  const auto simulator = fly(model, {"--config", scenario, "--run-duration-s", "75", "--rate", "max"});
  double worst_before = 0.0;
  const auto judge = [&] {
    for (const EngineHealth& h : std::exchange(listener_.health, {})) {
      const auto truth = listener_.truth.find(h.sequence_number());
      if (truth == listener_.truth.end() || h.sequence_number() < 2000 || h.sequence_number() >= 4000) continue;
      for (std::size_t i = 0; i < h.health_count(); ++i)
        worst_before = std::max(worst_before, std::abs(h.health()[i] - truth->second.health()[i]) / h.sigma_total()[i]);
    }
  };
  ASSERT_TRUE(listener_.await(
      [&] {
        judge();
        return !simulator->running() && listener_.has_event(idl::EventKind::sensor_fault, true);
      },
      seconds(40)))
      << simulator->log() << monitor_->log();
  ASSERT_FALSE(listener_.truth.empty());
  EXPECT_DOUBLE_EQ(listener_.truth.rbegin()->second.health()[4], -0.02);
  EXPECT_GT(worst_before, 0.0);
  EXPECT_LT(worst_before, 4.5);  // of ten parameters, over 30 s
  EXPECT_STREQ(listener_.find_event(idl::EventKind::sensor_fault, true)->channel_name().c_str(), "T30");
  EXPECT_EQ(listener_.status.back().samples_lost(), 0u);
  const auto described = std::find_if(listener_.descriptions.begin(), listener_.descriptions.end(), [](const auto& d) {
    return d.role() == static_cast<std::uint32_t>(idl::DescriptionRole::source);
  });
  ASSERT_NE(described, listener_.descriptions.end());
  EXPECT_STREQ(described->sensors()[5].name().c_str(), "T30");
  EXPECT_FALSE(listener_.has_event(idl::EventKind::source_channels, true));
}

TEST_F(OwnEngineTest, WithoutControlsIsFlownRecordedAndReplayed) {
  Json model = cruise_model();
  model["controls"] = Json::array();
  for (const char* name : {"B", "D", "G"})
    for (auto& row : model[name]) row = Json::array();
  const std::string model_file = write("model.json", model), record = folder_.path("flight.h5");
  const std::string design_of_it = design(model_file, "design.json");
  start({"--monitor-design", design_of_it, "--record", record});
  const auto simulator = fly(model_file, {"--run-duration-s", "1.5", "--rate", "max"});
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() == 100; })) << simulator->log();
  EXPECT_EQ(listener_.sensors.back().actuator_count(), 0u);
  ASSERT_TRUE(
      listener_.await([&] { return !listener_.status.empty() && listener_.status.back().samples_processed() == 100; }));
  EXPECT_EQ(listener_.status.back().samples_malformed(), 0u);
  ASSERT_TRUE(await_end(*simulator));
  monitor_->signal(SIGTERM);
  ASSERT_EQ(monitor_->wait(seconds(5)), 0);
  const std::vector<EngineHealth> flown = std::exchange(listener_.health, {});

  start({"--monitor-design", design_of_it});
  Process replay({simulator_program(), "--dds-domain", std::to_string(domain_), "--replay", record, "--rate", "max",
                  "--run-wait-for-monitors", "2"});
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() == flown.size() && !replay.running(); }))
      << listener_.health.size() << monitor_->log() << replay.log();
  for (std::size_t k = 0; k < flown.size(); ++k)
    EXPECT_EQ(listener_.health[k].health(), flown[k].health()) << k;  // to the bit
}

TEST_F(OwnEngineTest, TheBiasOfOneOfTwoProbesOfTheSameIsNamed) {
  Json model = cruise_model();
  ASSERT_EQ(model["sensors"][6]["name"], "T48");
  Json probe = model["sensors"][6];
  probe["name"] = "T48b";
  model["sensors"].push_back(probe);
  for (const char* name : {"C", "D", "M"}) model[name].push_back(model[name][6]);
  model.erase("linearisation_error");
  const std::string model_file = write("model.json", model);
  start({"--monitor-design", design(model_file, "design.json"), "--monitor-clock", "source"});
  constexpr std::uint64_t onset = 1500;
  const double bias = 8.0 * probe["noise_sigma"].get<double>();
  const std::string scenario = folder_.file(
      "scenario.toml", "[[sensor_fault]]\nsensor = \"T48b\"\nkind = \"bias\"\ntime_s = 22.5\nmagnitude = " +
                           std::to_string(bias) + "\n");
  const auto simulator = fly(model_file, {"--config", scenario, "--run-duration-s", "30", "--rate", "max"});
  ASSERT_TRUE(listener_.await([&] { return listener_.has_event(idl::EventKind::sensor_fault, true); }))
      << simulator->log() << monitor_->log();
  const HealthEvent* named = listener_.find_event(idl::EventKind::sensor_fault, true);
  EXPECT_GE(named->sequence_number(), onset);
  EXPECT_EQ(named->channel(), 7u) << named->message();
  EXPECT_THAT(std::string(named->message().c_str()), HasSubstr("T48b"));
  EXPECT_NEAR(named->value(), bias, 0.3 * bias);
  ASSERT_TRUE(await_end(*simulator));
  EXPECT_FALSE(listener_.has_event(idl::EventKind::health_shift, true));
}

TEST_F(OwnEngineTest, ADesignInOtherUnitsIsTakenInFlight) {
  const Json kelvin = cruise_model();
  Json celsius = kelvin;
  for (auto& sensor : celsius["sensors"])
    if (sensor["unit"] == "K") {
      sensor["unit"] = "degC";
      sensor["trim"] = sensor["trim"].get<double>() - 273.15;
    }
  const std::string model_file = write("kelvin.json", kelvin);
  const std::string before = design(model_file, "before.json"),
                    after = design(write("celsius.json", celsius), "after.json");
  const auto configure = [&](const std::string& file) {
    return folder_.file("monitor.toml", "[monitor]\ndesign = \"" + file + "\"\n");
  };
  start({"--config", configure(before)});
  const auto simulator = fly(model_file, {});  // and describes itself in kelvin
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > 200; })) << simulator->log();
  configure(after);
  monitor_->signal(SIGHUP);
  ASSERT_TRUE(listener_.await([&] { return listener_.has_event(idl::EventKind::configuration, false); }));
  const std::size_t flown = listener_.residuals.size();
  ASSERT_TRUE(listener_.await([&] { return listener_.residuals.size() > flown + 200; }));
  simulator->signal(SIGINT);
  ASSERT_TRUE(await_end(*simulator));
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() == listener_.residuals.size(); }))
      << "a sample without an estimate";
  EXPECT_FALSE(listener_.has_event(idl::EventKind::source_channels, true));
  for (std::size_t k = flown; k < listener_.residuals.size(); ++k) {
    ASSERT_EQ(listener_.residuals[k].fused(), 0b1111111u) << k;
    ASSERT_NEAR(listener_.residuals[k].innovation()[6], 0.0, 40.0) << k;  // T48; unconverted it were 273
  }
  EXPECT_THAT(monitor_->log(), HasSubstr("the first T24 from K to degC"));
}

TEST_F(OwnEngineTest, AModelThatIsWrongIsNamedAndNothingFlies) {
  Json model = cruise_model();
  model["health"][2]["sigma"] = 0;
  const std::string file = write("model.json", model);
  Process process({simulator_program(), "--linear", file, "--check-config"});
  EXPECT_EQ(process.wait(seconds(20)), 2);
  EXPECT_THAT(process.log(), HasSubstr("engine_sim: 'linear.model': " + file + ": health[2].sigma is 0"));
}

}  // namespace
