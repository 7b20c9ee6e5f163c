// SPDX-License-Identifier: Apache-2.0
// `tuner_design baselines` and `tuner_design sensors`: what they write, and how they refuse.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "deploy/runtime/files/atomic_file.h"
#include "deploy/runtime/files/csv_table.h"
#include "deploy/runtime/files/file_error.h"
#include "engine_sim/linear_model/model_file.h"
#include "monitor/design/design_file.h"
#include "tests/unit/tuner_design/cli/run_command.h"
#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/design/design_tuner.h"

namespace ehm::tuner_design {
namespace {

using test::run_command;
using ::testing::HasSubstr;
using Json = nlohmann::json;

std::string model_on_disk() {
  const std::string path = test::temporary_path("selection_model.json");
  linear_model::write_model(test::made_up_model(6, 8), path);
  return path;
}

std::string design_on_disk() {
  const std::string path = test::temporary_path("selection_design.json");
  design::write_design(design_tuner(test::made_up_model(4, 6), {}), path);
  return path;
}

double number(const files::CsvTable& table, std::size_t row, const std::string& column) {
  return files::parse_number(table.rows.at(row).cells.at(table.column(column).value())).value();
}

TEST(BaselinesCommand, JsonAndCsvHaveTheSameNumbers) {
  const std::string csv = test::temporary_path("baselines.csv");
  const auto result = run_command({"baselines", design_on_disk(), "--csv", csv, "--json", "--subset", "h0", "h1"});
  ASSERT_EQ(result.code, 0) << result.err;
  const Json rows = Json::parse(result.out).at("baselines");
  const files::CsvTable table = files::read_csv(csv);
  ASSERT_EQ(rows.size(), table.rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(table.rows[i].cells[0], rows[i].at("name").get<std::string>());
    EXPECT_EQ(number(table, i, "ssee_health"), rows[i].at("ssee_health").at("total").get<double>());
    EXPECT_EQ(number(table, i, "Fn"), rows[i].at("ssee_auxiliary").at("by_channel").at("Fn").get<double>());
  }
  EXPECT_THAT(run_command({"baselines", design_on_disk()}).out, HasSubstr("gauss_markov"));
}

TEST(BaselinesCommand, MistakesExitWithTwo) {
  EXPECT_EQ(run_command({"baselines", "/nonexistent/d.json"}).code, 2);
  const auto unknown = run_command({"baselines", design_on_disk(), "--subset", "wing"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("no health parameter wing"));
  EXPECT_EQ(run_command({"baselines", design_on_disk(), "--run-s", "0"}).code, 2);
  EXPECT_EQ(run_command({"baselines", design_on_disk(), "--run-s", "1e9"}).code, 2);
  EXPECT_THAT(run_command({"baselines", design_on_disk(), "--run-s", "1e9"}).err, HasSubstr("1 to 1000000 samples"));
}

TEST(SensorsCommand, FrontGoesToJsonAndCsv) {
  const std::string csv = test::temporary_path("front.csv");
  const std::vector<std::string> arguments{"sensors", model_on_disk(), "--cost", "y2=2.5", "y4=0.5", "--keep",
                                           "N1",      "--csv",         csv,      "--json"};
  const auto result = run_command(arguments);
  ASSERT_EQ(result.code, 0) << result.err;
  const Json json = Json::parse(result.out);
  const files::CsvTable table = files::read_csv(csv);
  ASSERT_EQ(json.at("front").size(), table.rows.size());
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const Json& point = json.at("front")[i];
    EXPECT_EQ(number(table, i, "cost"), point.at("cost").get<double>());
    EXPECT_EQ(number(table, i, "j"), point.at("j").get<double>());
    EXPECT_EQ(number(table, i, "N1"), 1.0) << "to be kept";
    double cost = 0.0;
    for (const auto& name : point.at("sensors")) cost += name == "y2" ? 2.5 : name == "y4" ? 0.5 : 1.0;
    EXPECT_DOUBLE_EQ(point.at("cost").get<double>(), cost);
  }
  EXPECT_EQ(json.at("sets"), 32);
  EXPECT_EQ(json.at("single_sensors").size(), 6U);
  EXPECT_EQ(json.at("single_sensors").at("y2").at("cost"), 2.5);
  EXPECT_EQ(run_command(arguments).out, result.out);
  EXPECT_THAT(run_command({"sensors", model_on_disk()}).out, HasSubstr("all but"));
}

TEST(SensorsCommand, CostsComeFromAFileToo) {
  const std::string file = test::temporary_path("costs.csv");
  files::write_file_atomically(file, "sensor,cost\ny3,7\nN2,0\n");
  const auto result = run_command({"sensors", model_on_disk(), "--cost", file, "N2=4", "--json"});
  ASSERT_EQ(result.code, 0) << result.err;
  const Json single = Json::parse(result.out).at("single_sensors");
  EXPECT_EQ(single.at("y3").at("cost"), 7.0);
  EXPECT_EQ(single.at("N2").at("cost"), 4.0) << "what comes later wins";
  EXPECT_EQ(single.at("y2").at("cost"), 1.0);
}

TEST(SensorsCommand, TwentyCandidatesAreReadAndTwentyOneAreNot) {
  // More than a design may have, so they are written by hand.
  const auto candidates = [](int count) {
    const std::string path = model_on_disk();
    Json json = Json::parse(std::ifstream(path));
    for (int i = 6; i < count; ++i) {
      Json channel = json.at("sensors")[5];
      channel["name"] = "y" + std::to_string(i);
      json["sensors"].push_back(channel);
      for (const char* key : {"C", "D", "M"}) json[key].push_back(json.at(key)[5]);
    }
    const std::string more = test::temporary_path("candidates.json");
    files::write_file_atomically(more, json.dump());
    return more;
  };
  const auto twenty = run_command({"sensors", candidates(20), "--max-sensors", "2", "--json"});
  ASSERT_EQ(twenty.code, 0) << twenty.err;
  EXPECT_EQ(Json::parse(twenty.out).at("sets"), 20 + 190);
  const auto more = run_command({"sensors", candidates(21)});
  EXPECT_EQ(more.code, 2);
  EXPECT_THAT(more.err, HasSubstr("sensors is 21 channels long; allowed: 1 to 20 channels"));
  EXPECT_EQ(run_command({"design", "--model", candidates(17), "--out", test::temporary_path("d17.json")}).code, 2);
}

TEST(SensorsCommand, MistakesExitWithTwoAndName) {
  const std::string model = model_on_disk();
  const auto expect = [&](std::vector<std::string> more, const char* text) {
    more.insert(more.begin(), {"sensors", model});
    const auto result = run_command(more);
    EXPECT_EQ(result.code, 2) << text;
    EXPECT_THAT(result.err, HasSubstr(text));
  };
  expect({"--cost", "y9=1"}, "--cost y9=1: unknown sensor 'y9'; allowed: N1, N2, y2, y3, y4, y5");
  expect({"--cost", "y2=-1"}, "--cost y2=-1: cost is '-1'; allowed: a finite number, 0 or above");
  expect({"--cost", "y2=nan"}, "cost is 'nan'");
  expect({"--cost", "/nonexistent/costs.csv"}, "/nonexistent/costs.csv");
  expect({"--keep", "wing"}, "--keep wing: unknown sensor 'wing'");
  expect({"--keep", "N1", "--budget", "0.5"}, "allow no set of sensors");
  expect({"--qh", "nan"}, "'nan' is not a number from 1e-12 to 100");
  expect({"--budget", "-1"}, "'-1' is not a finite number, 0 or above");
  expect({"--max-sensors", "0"}, "--max-sensors");
  expect({"--weight-health", "0"}, "not in range");  // theory.md, section 6: health would go wild
  expect({"--weight", "wing=2"}, "no auxiliary output 'wing'");
  const std::string file = test::temporary_path("wrong_costs.csv");
  for (const auto& [content, text] : std::vector<std::pair<std::string, std::string>>{
           {"sensor,price\ny3,7\n", ":1: the columns are to be sensor and cost"},
           {"sensor,cost\ny3,7\ny3,8\n", ":3: sensor 'y3' appears twice"},
           {"sensor,cost\ny3,cheap\n", ":2: cost is 'cheap'"}}) {
    files::write_file_atomically(file, content);
    expect({"--cost", file}, (file + text).c_str());
  }
}

}  // namespace
}  // namespace ehm::tuner_design
