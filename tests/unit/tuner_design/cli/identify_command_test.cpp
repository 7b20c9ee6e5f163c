// SPDX-License-Identifier: Apache-2.0
// tuner_design identify: recordings of a linear engine and of our own nonlinear one, CSV files, and what is refused.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "deploy/runtime/recording/writer.h"
#include "engine_sim/linear_model/model_file.h"
#include "engine_sim/simulation.h"
#include "tests/unit/tuner_design/cli/run_command.h"
#include "tests/unit/tuner_design/identify/walking_engine.h"
#include "tuner_design/linearise/linearise.h"

namespace ehm::tuner_design {
namespace {

using ::testing::HasSubstr;
constexpr auto& run = test::run_command;

std::vector<recording::Channel> described(const std::vector<linear_model::Channel>& channels) {
  std::vector<recording::Channel> all;
  for (const auto& channel : channels) all.push_back({channel.name, channel.unit});
  return all;
}

/// A file that a monitor might have recorded.
class RecordingFile {
 public:
  RecordingFile(const std::string& name, const linear_model::LinearModel& model)
      : path_(test::temporary_path(name)), writer_(cleared(path_), info(model)) {}

  void add(std::int64_t engine, std::int64_t sequence, const Eigen::VectorXd& flight, const Eigen::VectorXd& controls,
           const Eigen::VectorXd& sensors) {
    recording::Row row;
    row.a.unit = engine;
    row.a.sequence = sequence;
    row.a.source_time_ns = 1'000'000'000 + 15'000'000 * sequence;
    row.a.accepted = 1;
    std::copy(flight.begin(), flight.end(), row.w.begin());
    std::copy(controls.begin(), controls.end(), row.w.begin() + recording::flight_channels);
    std::copy(sensors.begin(), sensors.end(), row.x_s.begin());
    for (Eigen::Index i = 0; i < sensors.size(); ++i)
      if (std::isfinite(sensors(i))) row.a.sensor_valid |= std::int64_t{1} << i;
    add(row);
  }
  void add(const recording::Row& row) {
    writer_.append(row, writer_.design_index("none"));
    if (writer_.pending() >= 1024) writer_.commit(false);
  }
  void add(std::int64_t engine, const RecordedSamples& record, const std::set<Eigen::Index>& lost = {}) {
    for (Eigen::Index k = 0; k < record.sensors.cols(); ++k)
      if (!lost.contains(k)) add(engine, k, record.flight.col(k), record.controls.col(k), record.sensors.col(k));
  }
  std::string finished() {
    writer_.commit(true);
    return path_;
  }

 private:
  static const std::string& cleared(const std::string& path) {
    std::filesystem::remove(path);
    return path;
  }
  static recording::FileInfo info(const linear_model::LinearModel& model) {
    recording::FileInfo info;
    info.recording_id = 1;
    info.sample_time_s = model.sample_time_s;
    info.created_by = "test";
    info.channels = {described(model.controls), described(model.sensors), described(model.auxiliary),
                     described(model.health)};
    return info;
  }

  std::string path_;
  recording::Writer writer_;
};

std::string made_up_on_disk() {
  const std::string path = test::temporary_path("identify_model.json");
  linear_model::write_model(test::made_up_model(), path);
  return path;
}

/// Of engines 1 and 2.
std::string two_engines() {
  const auto model = test::made_up_model();
  RecordingFile file("identify_two.h5", model);
  file.add(1, test::walking_engine(model, test::noise_of(model, 1e-3), 3000, 1));
  file.add(2, test::walking_engine(model, test::noise_of(model, 1e-3), 2500, 2));
  return file.finished();
}

TEST(IdentifyCommand, PrintsTheSameNumbersAsTableAndJsonAndWritesTheModel) {
  const std::string out = test::temporary_path("identified.json");
  std::vector<std::string> arguments{"identify",    "--recording", two_engines(), "--model", made_up_on_disk(),
                                     "--engine-id", "1",           "--out",       out};
  const auto table = run(arguments);
  ASSERT_EQ(table.code, 0) << table.err;
  EXPECT_THAT(table.out, HasSubstr("3000 recorded, 3000 used: 45 s steady"));
  EXPECT_THAT(table.out, HasSubstr("nothing stands out among the sensors"));
  arguments.push_back("--json");
  const auto json = nlohmann::json::parse(run(arguments).out);
  EXPECT_EQ(json.at("samples").at("used"), 3000);
  ASSERT_EQ(json.at("sensors").size(), 4U);
  const auto model = test::made_up_model(), written = linear_model::read_model(out);
  for (std::size_t i = 0; i < 4; ++i) {
    const double sigma = json.at("sensors")[i].at("sigma");
    EXPECT_EQ(sigma, written.sensor_noise_sigma(as_index(i)));
    EXPECT_NEAR(sigma / model.sensor_noise_sigma(as_index(i)), 1.0, 0.08);
  }
  EXPECT_NEAR(json.at("walk_percent2").at("value").get<double>() / 1e-3, 1.0, 0.5);
  EXPECT_EQ(json.at("walks_percent2").size(), 6U);
}

TEST(IdentifyCommand, MendsLostSamplesCutsAtAGapAndCountsWhatWasNotAccepted) {
  const auto model = test::made_up_model();
  RecordingFile file("identify_lost.h5", model);
  std::set<Eigen::Index> lost{100, 200, 201};
  for (Eigen::Index k = 3000; k < 3010; ++k) lost.insert(k);
  file.add(1, test::walking_engine(model, test::noise_of(model, 1e-3), 5000, 1), lost);
  recording::Row duplicate;
  duplicate.a.unit = 1;
  duplicate.a.sequence = 4999;
  file.add(duplicate);
  const auto result = run({"identify", "--recording", file.finished(), "--model", made_up_on_disk(), "--json"});
  ASSERT_EQ(result.code, 0) << result.err;
  const auto samples = nlohmann::json::parse(result.out).at("samples");
  EXPECT_EQ(samples.at("recorded"), 4990);
  EXPECT_EQ(samples.at("mended"), 3);
  EXPECT_EQ(samples.at("gaps"), 1);
  EXPECT_EQ(samples.at("pieces"), 2);
  EXPECT_EQ(samples.at("not_accepted"), 1);
}

TEST(IdentifyCommand, TakesTheModelOfADesign) {
  const std::string design = test::temporary_path("identify_design.json");
  ASSERT_EQ(run({"design", "--model", made_up_on_disk(), "--out", design, "--quiet"}).code, 0);
  const auto result = run({"identify", "--recording", two_engines(), "--design", design, "--engine-id", "2"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("engine 2"));
}

/// Our own nonlinear engine in flight at cruise, its control at work, and the model that is made of it there.
class IdentifyOurOwnEngine : public ::testing::Test {
 protected:
  IdentifyOurOwnEngine() {
    LineariseOptions options;
    options.flight = {10668.0, 0.8, 0.0};
    options.demand = {engine_sim::DemandKind::t40_k, cruise_t40_k};
    options.fleet = 0;
    model_ = linearise(engine_sim::default_engine(), options).model;
    linear_model::write_model(model_, model_path_);
  }

  nlohmann::json identified(const engine_sim::Scenario& scenario, int samples) const {
    engine_sim::Simulation simulation(scenario);
    RecordingFile file("identify_cruise.h5", model_);
    for (int k = 0; k < samples; ++k) {
      const engine_sim::EngineSample sample = simulation.next_sample();
      Eigen::VectorXd sensors(as_index(sample.sensors.size()));
      for (std::size_t i = 0; i < sample.sensors.size(); ++i) sensors(as_index(i)) = sample.sensors[i].value;
      file.add(1, k, Eigen::Vector3d(sample.flight.altitude_m, sample.flight.mach, sample.flight.delta_isa_k),
               Eigen::Map<const Eigen::VectorXd>(sample.actuators.data(), as_index(sample.actuators.size())), sensors);
    }
    const auto result = run({"identify", "--recording", file.finished(), "--model", model_path_, "--json"});
    EXPECT_EQ(result.code, 0) << result.err;
    return nlohmann::json::parse(result.out);
  }
  void expect_sensors_within_5_percent(const nlohmann::json& json) const {
    for (std::size_t i = 0; i < model_.sensors.size(); ++i) {
      const auto& sensor = json.at("sensors")[i];
      const double ratio = sensor.at("sigma").get<double>() / model_.sensor_noise_sigma(as_index(i));
      EXPECT_NEAR(ratio * ratio, 1.0, 0.05) << sensor.dump();
    }
  }

  linear_model::LinearModel model_;
  std::string model_path_ = test::temporary_path("identify_cruise.json");
};

TEST_F(IdentifyOurOwnEngine, RIsWithin5PercentAndAConstantEngineDoesNotWalk) {
  const auto json = identified({}, 16000);
  EXPECT_EQ(json.at("samples").at("used"), 16000);
  expect_sensors_within_5_percent(json);
  EXPECT_FALSE(json.at("walk_percent2").at("told"));
  EXPECT_TRUE(json.at("remarks").empty()) << json.at("remarks").dump();
}

/// Health steps at random each 32 samples: below 1 Hz, where a walk is seen, that is a walk.
TEST_F(IdentifyOurOwnEngine, TheWalkOfItsHealthIsWithin30Percent) {
  constexpr double walk_percent2 = 2e-5;
  constexpr int samples = 40000, apart = 32;
  test::Random random(9);
  engine_sim::Scenario scenario;
  for (int k = 0; k < samples; k += apart)
    for (std::size_t i = 0; i < engine_sim::health_count; ++i)
      scenario.health_changes.push_back({0.015 * k, i, 0.01 * std::sqrt(walk_percent2 * apart) * random.normal(), 0.0});
  const auto json = identified(scenario, samples);
  expect_sensors_within_5_percent(json);
  EXPECT_TRUE(json.at("walk_percent2").at("told"));
  EXPECT_NEAR(json.at("walk_percent2").at("value").get<double>() / walk_percent2, 1.0, 0.30);
}

TEST(IdentifyCommand, ReadsACsvFileInItsOwnUnitsAndCutsItWhereTimeJumps) {
  const auto model = test::made_up_model();
  const RecordedSamples record = test::walking_engine(model, test::noise_of(model, 1e-3), 4000, 4);
  const std::string csv = test::temporary_path("identify.csv"), map = test::temporary_path("identify.toml");
  std::ofstream table(csv);
  table << "t,Wf,y3,y2,N2,N1\n";
  for (Eigen::Index k = 0; k < 4000; ++k) {
    const double t = 0.015 * static_cast<double>(k) + (k < 1500 ? 0.0 : 7.0);
    table << t << ',' << record.controls(0, k);
    table.precision(12);
    // degrees Celsius; the model has K
    table << ',' << record.sensors(3, k) - 273.15 << ',' << (k == 100 ? "nan" : std::to_string(record.sensors(2, k)))
          << ',' << record.sensors(1, k) << ',' << record.sensors(0, k) << '\n';
  }
  table.close();
  std::ofstream(map) << R"([file]
separator = "comma"
header = true
time_column = "t"
seconds_per_unit = 1.0
engine_id = 3
[[flight]]
name = "altitude_m"
value = 0
[[flight]]
name = "mach"
value = 0
[[flight]]
name = "delta_isa_k"
value = 0
[[actuator]]
name = "Wf"
column = "Wf"
unit = "kg/s"
[[sensor]]
name = "y3"
column = "y3"
unit = "degC"
[[sensor]]
name = "N2"
column = "N2"
unit = "rpm"
[[sensor]]
name = "y2"
column = "y2"
unit = "K"
[[sensor]]
name = "N1"
column = "N1"
unit = "rpm"
)";
  const auto result =
      run({"identify", "--recording", csv, "--column-map", map, "--model", made_up_on_disk(), "--json"});
  ASSERT_EQ(result.code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json.at("engine_id"), 3);
  EXPECT_EQ(json.at("samples").at("gaps"), 1);
  EXPECT_EQ(json.at("samples").at("mended"), 1);
  EXPECT_EQ(json.at("samples").at("pieces"), 2);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(json.at("sensors")[i].at("sigma").get<double>() / model.sensor_noise_sigma(as_index(i)), 1.0, 0.08);
  const auto wrong = run({"identify", "--recording", csv, "--column-map", csv, "--model", made_up_on_disk()});
  EXPECT_EQ(wrong.code, 2) << wrong.err;
}

TEST(IdentifyCommand, WhatIsWrongIsSaidInOneMessage) {
  const std::string recording = two_engines(), model = made_up_on_disk();
  const auto refused = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "identify");
    const auto result = run(arguments);
    EXPECT_EQ(result.code, 2) << result.out << result.err;
    return result.err;
  };
  EXPECT_THAT(refused({"--recording", recording}), HasSubstr("one of --design and --model"));
  EXPECT_THAT(refused({"--recording", recording, "--model", model}), HasSubstr("has the engines 1, 2"));
  EXPECT_THAT(refused({"--recording", recording, "--model", model, "--engine-id", "7"}), HasSubstr("no engine 7"));
  EXPECT_THAT(refused({"--recording", recording, "--model", model, "--engine-id", "1", "--out", model}),
              HasSubstr("is the input itself"));
  EXPECT_THAT(refused({"--recording", model, "--model", model}), HasSubstr(model));
  auto other = test::made_up_model();
  other.sensors[2].name = "T99";
  const std::string other_path = test::temporary_path("identify_other.json");
  linear_model::write_model(other, other_path);
  EXPECT_THAT(refused({"--recording", recording, "--model", other_path, "--engine-id", "1"}),
              HasSubstr("has no sensor T99, which the model needs; it has N1, N2, y2, y3"));
  other = test::made_up_model();
  other.sensors[2].unit = "Pa";
  linear_model::write_model(other, other_path);
  EXPECT_THAT(refused({"--recording", recording, "--model", other_path, "--engine-id", "1"}),
              HasSubstr("cannot be converted"));
  other = test::made_up_model();
  other.sample_time_s = 0.02;
  linear_model::write_model(other, other_path);
  EXPECT_THAT(refused({"--recording", recording, "--model", other_path, "--engine-id", "1"}),
              HasSubstr("a sample each 0.015 s, the model is made for 0.02 s"));
  other = test::made_up_model();
  other.controls[0].trim *= 2.0;
  linear_model::write_model(other, other_path);
  EXPECT_THAT(refused({"--recording", recording, "--model", other_path, "--engine-id", "1"}),
              HasSubstr("3000 are off the point"));
}

}  // namespace
}  // namespace ehm::tuner_design
