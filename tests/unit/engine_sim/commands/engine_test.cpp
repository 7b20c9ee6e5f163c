// SPDX-License-Identifier: Apache-2.0
// engine_sim engine export | check | show, as a user calls them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "deploy/runtime/files/input_file.h"
#include "deploy/runtime/files/json_object.h"
#include "engine_sim/engine_command/engine_check.h"
#include "engine_sim/engines/engine_file.h"
#include "engine_sim/engines/jt9d_engine.h"
#include "engine_sim/engines/shipped_engines.h"
#include "engine_sim/model/solve/steady.h"
#include "run_engine_sim.h"
#include "tests/temporary_folder.h"

namespace {

using namespace ehm;
using namespace ehm::engine_sim;
using files::Json;
using test::run_engine_sim;
using testing::AllOf;
using testing::HasSubstr;

class EngineCommand : public testing::Test {
 protected:
  test::TemporaryFolder folder_;
};

TEST_F(EngineCommand, ExportsTheShippedFiles) {
  for (const std::string& name : shipped_engine_list()) {
    const std::string shipped = std::string(EHM_SOURCE_DIR) + "/deploy/engines/" + name + ".json";
    const auto printed = run_engine_sim({"engine", "export", name});
    EXPECT_EQ(printed.code, 0) << printed.err;
    EXPECT_EQ(printed.out, files::read_input_file(shipped, files::json_file)) << name;
    const std::string path = folder_.path(name + ".json");
    EXPECT_EQ(run_engine_sim({"engine", "export", name, "--out", path}).code, 0);
    EXPECT_EQ(files::read_input_file(path, files::json_file), printed.out);
  }
}

TEST_F(EngineCommand, ShippedEnginesPassTheirCheck) {
  for (const std::string& name : shipped_engine_list()) {
    const auto result = run_engine_sim({"engine", "check", name});
    EXPECT_EQ(result.code, 0) << result.out << result.err;
    EXPECT_THAT(result.out, AllOf(HasSubstr("structure, values and maps are valid"),
                                  HasSubstr("envelope: 48 of 48 points converge")));
  }
}

// What is wrong with the file is a mistake of its writer; what is wrong with the engine is found by flying it.
TEST_F(EngineCommand, CheckTellsAFileFromAnEngineThatDoesNotRun) {
  Json json = Json::parse(engine_text(jt9d_engine()));
  json["design_point"]["n2_rpm"] = 8400.0;
  const auto other_design = run_engine_sim({"engine", "check", folder_.file("design.json", json.dump())});
  EXPECT_EQ(other_design.code, 1);
  EXPECT_THAT(other_design.out, HasSubstr("beyond 2 %"));
  EXPECT_EQ(other_design.err, "engine_sim engine: JT9D: the engine does not run as its file states\n");

  json["design_point"]["n2_rpm"] = 84000000.0;
  const std::string path = folder_.file("range.json", json.dump());
  const auto defect = run_engine_sim({"engine", "check", path});
  EXPECT_EQ(defect.code, 2);
  EXPECT_EQ(defect.err, "engine_sim engine: " + path +
                            ": design_point.n2_rpm is 84000000.0; allowed: 100.0 to 100000.0 (rpm). Correct the "
                            "value.\n");
}

TEST(EngineCheck, NamesThePointsThatFail) {
  EngineData data = jt9d_engine().data;
  data.core_nozzle.area_m2 *= 0.4;  // far too small: the LPT has no expansion left
  const EngineCheck check = check_engine(data);
  EXPECT_FALSE(check.passed());
  EXPECT_EQ(check.failed.empty() && check.surging.empty(), false);
  for (const std::string& text : check.failed) EXPECT_THAT(text, AllOf(HasSubstr(" m, Mach "), HasSubstr(": ")));
}

TEST_F(EngineCommand, ShowHasTheDesignPointsNumbers) {
  const auto result = run_engine_sim({"engine", "show", "jt9d"});
  EXPECT_EQ(result.code, 0) << result.err;
  const DesignPoint& d = jt9d_engine().data.design;
  const GasPath g =
      solve_steady(Turbofan(jt9d_engine().data), d.flight, {}, {DemandKind::fuel_flow_kg_s, d.fuel_flow_kg_s}).gas;
  const auto fixed = [](double value, int decimals) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return std::string(text);
  };
  for (const Station* s : {&g.s2, &g.s13, &g.s21, &g.s24, &g.s30, &g.s40, &g.s48, &g.s50})
    EXPECT_THAT(result.out, AllOf(HasSubstr(fixed(s->w_kg_s, 3)), HasSubstr(fixed(1e-3 * s->pt_pa, 3)),
                                  HasSubstr(fixed(s->tt_k, 2))));
  EXPECT_THAT(result.out, AllOf(HasSubstr(engine_hash(jt9d_engine())), HasSubstr("T48 0.75 %"),
                                HasSubstr("auxiliary  T40, T50, Fn, SmLPC"), HasSubstr("EGT margin")));
}

TEST_F(EngineCommand, AnUnknownEngineIsToldWithTheKnownOnes) {
  for (const char* action : {"export", "check", "show"}) {
    const auto result = run_engine_sim({"engine", action, "jt8d"});
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(result.err,
              "engine_sim engine: no engine is named 'jt8d'; allowed: jt9d, high_bypass, or an engine file, such as "
              "./jt8d.json\n");
  }
  EXPECT_EQ(run_engine_sim({"engine"}).code, 2);
  EXPECT_EQ(run_engine_sim({"engine", "check", "./absent.json"}).code, 2);
}

TEST_F(EngineCommand, ADeckIsOfTheEngineThatIsNamed) {
  const std::string cases = folder_.file("cases.csv", "altitude_m,mach,delta_isa_k,t40_k\n10668,0.8,0,1587.2\n");
  const std::string mine = folder_.file("mine.json", engine_text(*named_engine("high_bypass")));
  const auto by_name = run_engine_sim({"deck", "--cases", cases, "--out", "-", "--engine", "high_bypass"});
  const auto by_file = run_engine_sim({"deck", "--cases", cases, "--out", "-", "--engine", mine});
  const auto jt9d = run_engine_sim({"deck", "--cases", cases, "--out", "-"});
  EXPECT_EQ(by_name.code, 0) << by_name.err;
  EXPECT_EQ(by_name.out, by_file.out);
  EXPECT_NE(by_name.out, jt9d.out);
}

}  // namespace
