// SPDX-License-Identifier: Apache-2.0
// fit_maps as a user meets it: what it makes of another engine's tables, and how it refuses mistakes.

#include "engine_sim/map_fit/fit_maps_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>

#include "tests/temporary_folder.h"

namespace ehm::engine_sim {
namespace {

using Json = nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::string content(const std::string& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// An invented engine of one compressor and one turbine, smooth enough that the fit must follow it.
Json tables() {
  Json maps;
  Json& c = maps["Booster"];
  c["NcVec"] = {{0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1}};
  c["RlineVec"] = {1.0, 1.4, 1.8, 2.0, 2.2, 2.6, 3.0};
  for (const double n : c["NcVec"][0]) {
    Json wc, pr, eff;
    for (const double r : c["RlineVec"]) {
      wc.push_back(100.0 * n * (1.0 + 0.1 * (r - 2.0)));
      pr.push_back(1.0 + n * n * (1.0 - 0.2 * (r - 1.0)));
      eff.push_back(0.88 - 0.1 * (r - 2.0) * (r - 2.0) - 0.2 * (n - 0.9) * (n - 0.9));
    }
    c["WcArray"].push_back(wc);
    c["PRArray"].push_back(pr);
    c["EffArray"].push_back(eff);
  }
  Json& t = maps["PT"];
  t["NcVec"] = {60.0, 80.0, 100.0, 120.0};
  t["PRVec"] = {1.5, 2.0, 3.0, 4.0, 5.0};
  for (const double n : t["NcVec"]) {
    Json wc, eff;
    for (const double p : t["PRVec"]) {
      wc.push_back(50.0 * std::sqrt(1.0 - std::exp(-3.0 * (p - 1.0))));
      eff.push_back(0.9 - 1e-5 * (n - 100.0) * (n - 100.0));
    }
    t["WcArray"].push_back(wc);
    t["EffArray"].push_back(eff);
  }
  return maps;
}

Json settings() {
  return Json::parse(R"({
    "namespace": "demo_maps", "source": "invented",
    "compressors": [{
      "name": "Booster", "flow_exponent": 1.0, "pressure_exponent": 2.0,
      "speed_breaks": [0.05, 0.5, 0.8, 1.1],
      "r_line_breaks": [1.0, 2.0, 2.6, 3.0, 3.8],
      "surge_flow_breaks": [45.0, 70.0, 99.0],
      "corner": {"at": 0.9, "moved_to": 0.92},
      "straight_flow": {"speed_from": 0.8, "speed_to": 1.0, "speed_step": 0.1,
        "r_line_by_speed": [[0.8, 1.9], [1.0, 2.1]], "r_line_extent": 0.2, "points_along": 3,
        "speed_per_r_line": 0.05, "r_line_step": 0.05, "weight": 0.01}}],
    "turbines": [{"name": "PT", "choking_rate": 3.0, "speed_breaks": [60, 90, 120],
      "pressure_ratio_breaks": [1.5, 3, 5]}]
  })");
}

class FitMaps : public ::testing::Test {
 protected:
  int run(const std::string& settings_file, const std::string& maps_file) {
    const char* arguments[] = {"fit_maps", settings_file.c_str(), maps_file.c_str(), folder_.c_str()};
    out_.str("");
    err_.str("");
    return run_fit_maps(4, arguments, out_, err_);
  }
  int run(const Json& s, const Json& m) {
    std::ofstream(folder_ + "/settings.json") << s;
    std::ofstream(folder_ + "/tables.json") << m;
    return run(folder_ + "/settings.json", folder_ + "/tables.json");
  }
  /// Expects a refusal with one line that names `file`, `key` and, unless empty, `allowed`; and that nothing is
  /// written.
  void refused(const Json& s, const Json& m, const std::string& file, const std::string& key,
               const std::string& allowed) {
    EXPECT_EQ(run(s, m), 2) << key;
    const std::string message = err_.str();
    EXPECT_THAT(message, AllOf(HasSubstr("/" + file + ": "), HasSubstr(key), HasSubstr(allowed)));
    EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 1) << message;
    EXPECT_FALSE(std::filesystem::exists(folder_ + "/demo_maps.cpp")) << key;
  }

  test::TemporaryFolder temporary_;
  const std::string& folder_ = temporary_.path();
  std::ostringstream out_, err_;
};

TEST_F(FitMaps, WritesAnAccessorForEachMapOfAnotherEngine) {
  Json s = settings();
  s["compressors"][0].erase("corner");
  s["compressors"][0].erase("straight_flow");
  ASSERT_EQ(run(s, tables()), 0) << err_.str();
  const std::string source = content(folder_ + "/demo_maps.cpp"), header = content(folder_ + "/demo_maps.h");
  EXPECT_THAT(source, AllOf(HasSubstr("#include \"demo_maps.h\""), HasSubstr("CompressorMapData booster() {"),
                            HasSubstr("Source of the tables: invented"), HasSubstr("booster_last_r_line = 3;")));
  EXPECT_THAT(header, AllOf(HasSubstr("namespace ehm::engine_sim::demo_maps {"),
                            HasSubstr("CompressorMapData booster();"), HasSubstr("TurbineMapData pt();")));
  // the limit that FittedMaps sets for the JT9D's flow, 0.5 % at worst
  double rms = 0.0, largest = 0.0;
  ASSERT_EQ(std::sscanf(out_.str().c_str(), "Booster: flow rms %lf max %lf", &rms, &largest), 2) << out_.str();
  EXPECT_GT(rms, 0.0);
  EXPECT_LT(largest, 0.5);
}

TEST_F(FitMaps, TakesACornerAndAStraightPath) {
  ASSERT_EQ(run(settings(), tables()), 0) << err_.str();
  const std::string with = content(folder_ + "/demo_maps.cpp");
  Json s = settings();
  s["compressors"][0].erase("corner");
  ASSERT_EQ(run(s, tables()), 0) << err_.str();
  const std::string without_corner = content(folder_ + "/demo_maps.cpp");
  s["compressors"][0].erase("straight_flow");
  ASSERT_EQ(run(s, tables()), 0) << err_.str();
  EXPECT_NE(with, without_corner);
  EXPECT_NE(without_corner, content(folder_ + "/demo_maps.cpp"));
}

TEST_F(FitMaps, RefusesMistakesInTheSettingsByTheirKey) {
  struct Mistake {
    const char* pointer;  ///< what is replaced, or removed if the value is null
    Json value;
    const char* key;
    const char* allowed;
  };
  const Mistake mistakes[] = {
      {"/namespace", nullptr, "namespace", "missing"},
      {"/namespace", "My Maps", "namespace", "lower case"},
      {"/include_folder", "/etc/\"x", "include_folder", "relative folder"},
      {"/source", "two\nlines", "source", "one line"},
      {"/compressors", Json::object(), "compressors", "an array"},
      {"/compresors", Json::array(), "compresors", "unknown"},
      {"/why", 3, "why", "text"},
      {"/compressors/0/name", "HP comp", "compressors[0].name", "letters, digits"},
      {"/turbines/0/name", "BOOSTER", "turbines[0].name", "no other map"},
      {"/compressors/0/flow_exponent", 0.0, "compressors[0].flow_exponent", "0.1 to 10"},
      {"/compressors/0/pressure_exponent", "2", "compressors[0].pressure_exponent", "a finite number"},
      {"/compressors/0/speed_breaks", {0.5, 0.8, 0.7}, "compressors[0].speed_breaks[2]", "above 0.8"},
      {"/compressors/0/speed_breaks", {0.5}, "compressors[0].speed_breaks", "2 to 40 numbers"},
      {"/compressors/0/speed_breaks", 0.5, "compressors[0].speed_breaks", "an array"},
      {"/compressors/0/corner/moved_to", 0.8, "compressors[0].corner.moved_to", "0.9 to 3"},
      {"/compressors/0/corner/to", 0.8, "compressors[0].corner.to", "unknown"},
      {"/compressors/0/straight_flow/points_along", 2.5, "straight_flow.points_along", "whole number"},
      {"/compressors/0/straight_flow/speed_step", 0.0002, "straight_flow.speed_step", "0.001 to 1.0"},
      {"/compressors/0/straight_flow/speed_step", nullptr, "straight_flow.speed_step", "missing"},
      {"/compressors/0/straight_flow/r_line_by_speed", {{1.0, 2.0}, {0.9, 2.0}}, "r_line_by_speed[1][0]", "above 1.0"},
      {"/compressors/0/straight_flow/weight", -0.1, "straight_flow.weight", "0.0 to 1000"},
      {"/turbines/0/choking_rate", 0, "turbines[0].choking_rate", "0.01 to 100"},
      {"/turbines/0/pressure_ratio_breaks", nullptr, "turbines[0].pressure_ratio_breaks", "missing"},
      // what shows only beside the tables
      {"/compressors/0/speed_breaks", {0.5, 1.5}, "compressors[0].speed_breaks[1]", "0.05 to 1.28"},
      {"/compressors/0/r_line_breaks", {0.5, 3.0}, "compressors[0].r_line_breaks[0]", "1.0 to 3.8"},
      {"/compressors/0/surge_flow_breaks", {45.0, 145.0}, "compressors[0].surge_flow_breaks[1]", "45.0 to 99.0"},
      {"/compressors/0/corner/at", 0.85, "compressors[0].corner.at", "0.6, 0.7, 0.8, 0.9, 1.0"},
      {"/compressors/0/corner/moved_to", 1.2, "compressors[0].corner.moved_to", "below 1.1"},
      {"/turbines/0/speed_breaks", {60, 130}, "turbines[0].speed_breaks[1]", "60.0 to 120.0"}};
  for (const Mistake& mistake : mistakes) {
    Json s = settings();
    const Json::json_pointer at(mistake.pointer);
    if (mistake.value.is_null()) {
      s.at(at.parent_pointer()).erase(at.back());
    } else {
      s[at] = mistake.value;
    }
    refused(s, tables(), "settings.json", mistake.key, mistake.allowed);
  }
}

TEST_F(FitMaps, RefusesAPathOfMorePointsThanASolveCarries) {
  Json s = settings();
  Json& path = s["compressors"][0]["straight_flow"];
  path["speed_step"] = 0.001;
  path["points_along"] = 10;  // 201 speeds
  refused(s, tables(), "settings.json", "compressors[0].straight_flow.speed_step", "at most 2000 points");
}

TEST_F(FitMaps, RefusesMistakesInTheTablesByTheirKey) {
  const auto with = [](const char* pointer, const Json& value) {
    Json m = tables();
    m[Json::json_pointer(pointer)] = value;
    return m;
  };
  const auto refuse = [&](const Json& m, const char* key, const char* allowed) {
    refused(settings(), m, "tables.json", key, allowed);
  };
  Json no_booster = tables();
  no_booster.erase("Booster");
  refuse(no_booster, "Booster", "missing");
  refuse(with("/Booster/NcVec", {50, 60, 70, 80, 90, 100, 110}), "Booster.NcVec[0]", "0.01 to 3.0");
  refuse(with("/Booster/RlineVec/0", 0.9), "Booster.RlineVec[0]", "1.0 to 20.0");
  refuse(with("/Booster/RlineVec/0", 1.1), "Booster.RlineVec[0]", "the surge line");
  refuse(with("/Booster/WcArray", Json::array({1, 2})), "Booster.WcArray", "7 rows of 7 numbers");
  refuse(with("/Booster/WcArray/2", Json::array({1, 2})), "Booster.WcArray[2]", "7 numbers");
  refuse(with("/Booster/WcArray/2/1", "x"), "Booster.WcArray[2][1]", "a finite number");
  refuse(with("/Booster/EffArray/0/0", 88.0), "Booster.EffArray[0][0]", "to 1.0");
  refuse(with("/Booster/PRArray/3", Json(7, 1.0)), "Booster.PRArray[3]", "Leave this speed line out");
  refuse(with("/Booster/EffArray/6", Json(7, 0.4)), "Booster.EffArray", "two highest speed lines");
  refuse(with("/PT/PRVec/0", 1.0), "PT.PRVec[0]", "1.01 to 100.0");
  refuse(with("/PT/EffArray/1/1", -0.1), "PT.EffArray[1][1]", "0.0 to 1.0");
}

TEST_F(FitMaps, RefusesFilesAndCommandLinesThatMakeNoSense) {
  EXPECT_EQ(run(folder_ + "/absent.json", folder_ + "/absent.json"), 2);
  EXPECT_THAT(err_.str(), HasSubstr("absent.json: no such file"));
  std::ofstream(folder_ + "/cut.json") << "{\"namespace\": ";
  EXPECT_EQ(run(folder_ + "/cut.json", folder_ + "/cut.json"), 2);
  EXPECT_THAT(err_.str(), HasSubstr("cut.json: is not complete JSON"));
  const char* no_folder[] = {"fit_maps", "a.json", "b.json", "/nowhere/at/all"};
  EXPECT_EQ(run_fit_maps(4, no_folder, out_, err_), 2);
  EXPECT_EQ(run_fit_maps(1, no_folder, out_, err_), 2);
  const char* help[] = {"fit_maps", "--help"};
  out_.str("");
  EXPECT_EQ(run_fit_maps(2, help, out_, err_), 0);
  EXPECT_THAT(out_.str(), AllOf(HasSubstr("RlineVec"), HasSubstr("Exit codes")));
}

/// Numbers may differ by 1e-6: another processor may round the last of nine digits otherwise.
void expect_same(const std::string& regenerated, const std::string& committed) {
  std::istringstream a(regenerated), b(committed);
  std::string x, y;
  int different = 0;
  while (a >> x && b >> y && different < 5) {
    if (x == y) continue;
    char *end_x = nullptr, *end_y = nullptr;
    const double u = std::strtod(x.c_str(), &end_x), v = std::strtod(y.c_str(), &end_y);
    const bool numbers = end_x != x.c_str() && end_y != y.c_str() && std::string(end_x) == end_y;
    const bool same = numbers && std::abs(u - v) <= 1e-6 * std::max({std::abs(u), std::abs(v), 1.0});
    EXPECT_TRUE(same) << x << " against " << y;
    different += same ? 0 : 1;
  }
  EXPECT_TRUE(a.eof() || different > 0);
  EXPECT_FALSE(static_cast<bool>(b >> y)) << "committed goes on with " << y;
}

TEST_F(FitMaps, TheCommittedMapsAreThoseOfTheCommittedSettings) {
  const std::string tables_file = std::string(EHM_REFERENCE_DIR) + "/jt9d_maps.json";
  if (!std::filesystem::exists(tables_file)) GTEST_SKIP() << "reference data is absent: set EHM_REFERENCE_DIR";
  const std::string committed = std::string(EHM_SOURCE_DIR) + "/engine_sim/engines";
  ASSERT_EQ(run(committed + "/jt9d_fit.json", tables_file), 0) << err_.str();
  expect_same(content(folder_ + "/jt9d_maps.cpp"), content(committed + "/jt9d_maps.cpp"));
  EXPECT_EQ(content(folder_ + "/jt9d_maps.h"), content(committed + "/jt9d_maps.h"));
}

}  // namespace
}  // namespace ehm::engine_sim
