// Engines that are known as matrices only, flown over DDS by a node of the user's own: one without controls, one with two
// probes of the same quantity, and one whose design changes its units in flight.

#include <gmock/gmock.h>

#include <csignal>
#include <fstream>
#include <random>

#include "deploy/recording/recording_rows.h"
#include "tests/integration/engine_samples.h"
#include "tests/integration/pair.h"
#include "tests/temporary_folder.h"

namespace {

using namespace ehm;
using namespace ehm::test;
using Json = nlohmann::json;
using testing::HasSubstr;

class OwnEngineTest : public PairTest {
 protected:
  static Json cruise_model() { return Json::parse(std::ifstream(EHM_MODEL_FILE)); }
  std::string design(const std::string& name, const Json& model) {
    const std::string file = folder_.file("model.json", model.dump());
    const std::string out = folder_.path(name);
    Process process({EHM_TUNER_DESIGN, "design", "--model", file, "--out", out});
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
  void await_match() {
    ASSERT_TRUE(listener_.await([&] { return sensors_.matched() == 2; }));  // the monitor and the listener
  }
  /// Sends samples with the design's noise, one by one, each once the one before is answered.
  template <class Change>
  void fly(EngineSamples& engine, const Json& design, std::size_t count, Change&& change) {
    for (std::size_t k = 0; k < count; ++k) {
      EngineSensors s = engine.next();
      for (std::size_t i = 0; i < s.sensor_count(); ++i) {
        const auto& channel = design["model"]["sensors"][i];
        s.sensor()[i] = channel["trim"].get<double>() + channel["noise_sigma"].get<double>() * noise_(random_);
      }
      change(s);
      const std::size_t before = listener_.residuals.size();
      // The first may leave before the monitor hears us: it is sent again until it is answered.
      bool answered = false;
      for (int tries = 0; tries < 20 && !answered; ++tries) {
        sensors_.write(s);
        answered = listener_.await([&] { return listener_.residuals.size() > before; }, seconds(1));
      }
      ASSERT_TRUE(answered) << k << "\n" << monitor_->log();
    }
  }
  TemporaryFolder folder_;
  wire::Writer<EngineSensors> sensors_{participant_};
  std::unique_ptr<Process> monitor_;
  std::mt19937 random_{12};
  std::normal_distribution<double> noise_;
};

TEST_F(OwnEngineTest, WithoutControlsIsFlownRecordedAndReplayed) {
  Json model = cruise_model();
  model["controls"] = Json::array();
  for (const char* name : {"B", "D", "G"})
    for (auto& row : model[name]) row = Json::array();
  const std::string design_of_it = design("design.json", model);
  const std::string record = folder_.path("flight.h5");
  start({"--monitor-design", design_of_it, "--record", record});
  await_match();
  EngineSamples engine(design_of_it, 1);
  fly(engine, Json::parse(std::ifstream(design_of_it)), 100,
      [](const EngineSensors& s) { ASSERT_EQ(s.actuator_count(), 0u); });
  ASSERT_EQ(listener_.health.size(), 100u);
  ASSERT_TRUE(
      listener_.await([&] { return !listener_.status.empty() && listener_.status.back().samples_processed() == 100; }));
  EXPECT_EQ(listener_.status.back().samples_malformed(), 0u);
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
  const std::string design_of_it = design("design.json", model);
  start({"--monitor-design", design_of_it});
  await_match();
  EngineSamples engine(design_of_it, 1);
  const Json json = Json::parse(std::ifstream(design_of_it));
  fly(engine, json, 1500, [](const EngineSensors&) {});
  EXPECT_EQ(listener_.find_event(wire::EventKind::sensor_fault, true), nullptr);
  const double bias = 8.0 * probe["noise_sigma"].get<double>();
  fly(engine, json, 400, [&](EngineSensors& s) { s.sensor()[7] += bias; });
  ASSERT_TRUE(listener_.await([&] { return listener_.has_event(wire::EventKind::sensor_fault, true); }))
      << monitor_->log();
  const HealthEvent* named = listener_.find_event(wire::EventKind::sensor_fault, true);
  EXPECT_EQ(named->channel(), 7u) << named->message();
  EXPECT_THAT(std::string(named->message().c_str()), HasSubstr("T48b"));
  EXPECT_NEAR(named->value(), bias, 0.3 * bias);
  EXPECT_FALSE(listener_.has_event(wire::EventKind::health_shift, true));
}

TEST_F(OwnEngineTest, ADesignInOtherUnitsIsTakenInFlight) {
  const Json kelvin = cruise_model();
  Json celsius = kelvin;
  for (auto& sensor : celsius["sensors"])
    if (sensor["unit"] == "K") {
      sensor["unit"] = "degC";
      sensor["trim"] = sensor["trim"].get<double>() - 273.15;
    }
  const std::string before = design("kelvin.json", kelvin), after = design("celsius.json", celsius);
  const auto configure = [&](const std::string& file) {
    return folder_.file("monitor.toml", "[monitor]\ndesign = \"" + file + "\"\n");
  };
  wire::Writer<EngineDescription> descriptions(participant_);
  EngineDescription described;
  described.engine_id(1);
  described.source_id(9);
  described.role(static_cast<std::uint32_t>(wire::DescriptionRole::source));
  described.schema(wire::schema_version);
  described.sensor_count(static_cast<std::uint32_t>(kelvin["sensors"].size()));
  for (std::size_t i = 0; i < kelvin["sensors"].size(); ++i) {
    described.sensors()[i].name() = kelvin["sensors"][i]["name"].get<std::string>();
    described.sensors()[i].unit() = kelvin["sensors"][i]["unit"].get<std::string>();
  }
  descriptions.write(described);
  start({"--config", configure(before)});
  await_match();
  EngineSamples engine(before, 1);
  const Json json = Json::parse(std::ifstream(before));
  fly(engine, json, 200, [](const EngineSensors&) {});
  configure(after);
  monitor_->signal(SIGHUP);
  ASSERT_TRUE(listener_.await([&] { return listener_.has_event(wire::EventKind::configuration, false); }));
  const std::size_t flown = listener_.residuals.size();
  fly(engine, json, 200, [](const EngineSensors&) {});
  EXPECT_EQ(listener_.health.size(), listener_.residuals.size());  // no sample without an estimate
  EXPECT_FALSE(listener_.has_event(wire::EventKind::source_channels, true));
  for (std::size_t k = flown; k < listener_.residuals.size(); ++k) {
    ASSERT_EQ(listener_.residuals[k].fused(), 0b1111111u) << k;
    ASSERT_NEAR(listener_.residuals[k].innovation()[6], 0.0, 40.0) << k;  // T48; unconverted it were 273
  }
  EXPECT_THAT(monitor_->log(), HasSubstr("the first T24 from K to degC"));
}

}  // namespace
