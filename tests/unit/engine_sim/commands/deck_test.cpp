// SPDX-License-Identifier: Apache-2.0
// `engine_sim deck`: what it accepts, refuses and writes.

#include "engine_sim/deck/deck.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "deploy/runtime/files/file_error.h"
#include "engine_sim/deck/deck_columns.h"
#include "engine_sim/engines/jt9d.h"
#include "engine_sim/model/units.h"
#include "run_engine_sim.h"
#include "tests/temporary_folder.h"
#include "tests/unit/engine_sim/model/reference_cases.h"

namespace ehm::engine_sim {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

class DeckTest : public testing::Test {
 protected:
  test::Result deck(const std::string& cases, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"deck", "--cases", folder_.file("cases.csv", cases), "--out", out_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test::run_engine_sim(arguments);
  }
  void expect_refused(const std::string& cases, const std::string& message) {
    const test::Result result = deck(cases);
    EXPECT_EQ(result.code, 2) << cases;
    EXPECT_THAT(result.err, StartsWith("engine_sim deck: " + folder_.path("cases.csv") + message)) << cases;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_FALSE(std::filesystem::exists(out_)) << cases;
  }
  files::CsvTable written() const { return files::read_csv(out_); }
  double number(const files::CsvTable& table, std::size_t row, const std::string& column) const {
    return files::parse_number(table.rows.at(row).cells.at(table.column(column).value())).value();
  }
  test::TemporaryFolder folder_;
  std::string out_ = folder_.path("deck.csv");
};

TEST_F(DeckTest, RepeatsTheInputsAsGivenAndNamesNoColumnTwice) {
  const test::Result result = deck("mach,net_thrust_n,altitude_m,delta_isa_k\r\n0.80, 4.0e4 ,10668.0,+0\r\n\r\n");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(folder_.content("deck.csv"),
              StartsWith("mach,net_thrust_n,altitude_m,delta_isa_k,converged,w_2_kg_s,pt_2_pa,tt_2_k,w_13_kg_s,"));
  EXPECT_THAT(folder_.content("deck.csv"), HasSubstr("\n0.80,4.0e4,10668.0,+0,1,"));
  const files::CsvTable table = written();  // would refuse a repeated name
  EXPECT_EQ(table.header.cells.size(), 4u + 1 + 24 + 14 - 1);
  for (const char* column : {"ps_30_pa", "n1_rpm", "n2_rpm", "fuel_flow_kg_s", "bypass_ratio", "overall_pressure_ratio",
                             "stall_margin_fan", "stall_margin_lpc", "stall_margin_hpc", "tt_50_k"})
    EXPECT_GT(number(table, 0, column), 0.0) << column;
}

TEST_F(DeckTest, EveryColumnReachesTheModel) {
  ASSERT_EQ(deck("altitude_m,mach,delta_isa_k,fuel_flow_kg_s,vsv_deg,vbv_fraction,core_nozzle_area_ratio,"
                 "customer_bleed_kg_s,power_offtake_w,health_fan_efficiency,health_fan_flow,health_lpc_efficiency,"
                 "health_lpc_flow,health_hpc_efficiency,health_hpc_flow,health_hpt_efficiency,health_hpt_flow,"
                 "health_lpt_efficiency,health_lpt_flow\n"
                 "10000,0.7,5,0.8,2,0.02,1.05,0.5,50000,-0.01,-0.011,-0.012,-0.013,-0.014,-0.015,-0.016,0.017,-0.018,"
                 "0.019\n")
                .code,
            0);
  const Operation operation{.flight = {10000.0, 0.7, 5.0},
                            .health = {-0.01, -0.011, -0.012, -0.013, -0.014, -0.015, -0.016, 0.017, -0.018, 0.019},
                            .geometry = {2.0, 0.02, 1.05},
                            .offtake = {0.5, 50000.0}};
  const GasPath expected = solve_steady(Turbofan(jt9d()), operation, {DemandKind::fuel_flow_kg_s, 0.8}).gas;
  const files::CsvTable table = written();
  EXPECT_EQ(number(table, 0, "w_48_kg_s"), expected.s48.w_kg_s);
  EXPECT_EQ(number(table, 0, "pt_21_pa"), expected.s21.pt_pa);
  EXPECT_EQ(number(table, 0, "tt_30_k"), expected.s30.tt_k);
  EXPECT_EQ(number(table, 0, "ps_30_pa"), expected.ps_30_pa);
  EXPECT_EQ(number(table, 0, "n2_rpm"), expected.speeds.n2_rpm);
  EXPECT_EQ(number(table, 0, "net_thrust_n"), expected.net_thrust_n);
  EXPECT_EQ(number(table, 0, "bypass_ratio"), expected.bypass_ratio);
  EXPECT_EQ(number(table, 0, "overall_pressure_ratio"), expected.overall_pressure_ratio);
  EXPECT_EQ(number(table, 0, "stall_margin_lpc"), expected.stall_margin_lpc_percent);
}

TEST_F(DeckTest, EveryKindOfDemandFindsTheSamePoint) {
  ASSERT_EQ(deck("altitude_m,mach,delta_isa_k,n1_rpm\n10668,0.8,0,3400\n").code, 0);
  const files::CsvTable by_speed = written();
  const double n2_rpm = number(by_speed, 0, "n2_rpm");
  const std::map<std::string, std::string> demands{
      {"fuel_flow_kg_s", "fuel_flow_kg_s"}, {"net_thrust_n", "net_thrust_n"}, {"t40_k", "tt_40_k"}};
  for (const auto& [demand, column] : demands) {
    const std::string value = files::shortest(number(by_speed, 0, column));
    ASSERT_EQ(deck("altitude_m,mach,delta_isa_k," + demand + "\n10668,0.8,0," + value + "\n").code, 0) << demand;
    EXPECT_NEAR(number(written(), 0, "n2_rpm"), n2_rpm, 1e-6 * n2_rpm) << demand;
  }
}

TEST_F(DeckTest, ACaseWithoutASteadyPointIsAnEmptyRowWithAReason) {
  const test::Result result = deck("altitude_m,mach,delta_isa_k,net_thrust_n\n0,0,0,100e3\n0,0,0,500e3\n");
  EXPECT_EQ(result.code, 0);
  EXPECT_THAT(result.err, HasSubstr(folder_.path("cases.csv") + ":3: no steady point: "));
  EXPECT_THAT(result.err, HasSubstr("residual '"));
  EXPECT_THAT(result.err, EndsWith("1 of 2 cases did not converge\n"));
  EXPECT_THAT(folder_.content("deck.csv"), EndsWith("\n0,0,0,500e3,0" + std::string(37, ',') + "\n"));
}

TEST_F(DeckTest, RefusesAMalformedFileBeforeItWritesAnything) {
  const std::string head = "altitude_m,mach,delta_isa_k,t40_k\n";
  expect_refused("", ": is empty");
  expect_refused(head, ": has no row");
  expect_refused("altitude_ft,mach,delta_isa_k,t40_k\n0,0,0,1400\n", ":1: unknown column 'altitude_ft', allowed are ");
  expect_refused("altitude_m;mach;delta_isa_k;t40_k\n0;0;0;1400\n", ":1: unknown column 'altitude_m;mach;");
  expect_refused("altitude_m,delta_isa_k,t40_k\n0,0,1400\n", ":1: column 'mach' is missing");
  expect_refused("altitude_m,mach,delta_isa_k\n0,0,0\n",
                 ":1: the demands are none, allowed is exactly one of fuel_flow_kg_s, net_thrust_n, t40_k, n1_rpm");
  expect_refused("altitude_m,mach,delta_isa_k,t40_k,n1_rpm\n0,0,0,1400,3000\n",
                 ":1: the demands are 't40_k' and 'n1_rpm', allowed is exactly one of ");
  expect_refused("altitude_m,mach,mach,delta_isa_k,t40_k\n0,0,0,0,1400\n", ":1: column 'mach' appears twice");
  expect_refused(head + "0,0,0,1400\n0,1.2,0,1400\n", ":3: 'mach' is '1.2', allowed is a number from 0 to 0.95\n");
  expect_refused(head + "0,0,0,1400\n0,zero,0,1400\n", ":3: 'mach' is 'zero', allowed is a number from 0 to 0.95\n");
  expect_refused(head + "0,nan,0,1400\n", ":2: 'mach' is 'nan', allowed");
  expect_refused(head + "0,0,inf,1400\n", ":2: 'delta_isa_k' is 'inf', allowed");
  expect_refused(head + "0,,0,1400\n", ":2: 'mach' is '', allowed");
  expect_refused(head + "0,0,0\n", ":2: 3 cells found, 4 expected");
  expect_refused(head + "0,0,0,1400,\n", ":2: 5 cells found, 4 expected");
  expect_refused(head + "0,0,0,\"1400\n", ":2: quotes do not match");
}

TEST_F(DeckTest, RefusesFilesThatItCannotUse) {
  const std::string cases = folder_.file("cases.csv", "altitude_m,mach,delta_isa_k,t40_k\n0,0,0,1400\n");
  const auto run = [&](const std::string& in, const std::string& out) {
    return test::run_engine_sim({"deck", "--cases", in, "--out", out});
  };
  EXPECT_EQ(run(folder_.path("nowhere.csv"), out_).code, 2);
  EXPECT_THAT(run(folder_.path("nowhere.csv"), out_).err, HasSubstr("nowhere.csv: no such file"));
  EXPECT_EQ(run(cases, folder_.path("no/folder.csv")).code, 2);
  EXPECT_THAT(run(cases, folder_.path("no/folder.csv")).err, HasSubstr("folder.csv: cannot be written: No such file"));
  EXPECT_THAT(run(cases, cases).err, HasSubstr("--out is the file of the cases itself"));
  EXPECT_THAT(folder_.content("cases.csv"), StartsWith("altitude_m"));
}

TEST_F(DeckTest, TheBytesDoNotDependOnTheThreads) {
  std::string cases = "altitude_m,mach,delta_isa_k,t40_k,health_hpc_efficiency\n";
  for (int i = 0; i < 1500; ++i) {  // more than a block
    const double altitude_m = 6.0 * (i % 1300), delta_isa_k = i % 50 - 20;
    const double t40_k = (4.0 + 0.004 * (i % 200)) * (288.15 - 0.0065 * altitude_m + delta_isa_k);
    cases += files::shortest(altitude_m) + "," + files::shortest(0.0003 * (i % 900)) + "," +
             files::shortest(delta_isa_k) + "," + (i % 500 == 7 ? "4000" : files::shortest(t40_k)) + ",-0.01\n";
  }
  const test::Result one = deck(cases, {"--threads", "1"});
  const std::string expected = folder_.content("deck.csv");
  ASSERT_EQ(one.code, 0);
  EXPECT_THAT(one.err, EndsWith("3 of 1500 cases did not converge\n"));
  for (const char* threads : {"2", "5"}) {
    const test::Result more = deck(cases, {"--threads", threads});
    EXPECT_EQ(more.err, one.err);
    EXPECT_TRUE(folder_.content("deck.csv") == expected) << threads << " threads";
  }
}

TEST_F(DeckTest, WritesToTheStandardOutputAndTellsItsSpeed) {
  const std::string cases = folder_.file("cases.csv", "altitude_m,mach,delta_isa_k,t40_k\n0,0,0,1400\n");
  const test::Result result = test::run_engine_sim({"deck", "--cases", cases, "--out", "-", "--verbose"});
  EXPECT_EQ(result.code, 0);
  EXPECT_THAT(result.out, HasSubstr("\n0,0,0,1400,1,"));
  EXPECT_THAT(result.err, HasSubstr(" points a second"));
}

TEST_F(DeckTest, RefusesAWrongCommandLine) {
  EXPECT_EQ(test::run_engine_sim({"deck"}).code, 2);
  EXPECT_EQ(test::run_engine_sim({"deck", "--cases", "a.csv", "--out", "b.csv", "--threads", "0"}).code, 2);
  EXPECT_EQ(test::run_engine_sim({"dekc"}).code, 2);
  EXPECT_EQ(test::run_engine_sim({"deck", "--help"}).code, 0);
  EXPECT_EQ(test::run_engine_sim({"--config", "x.toml"}).code, -1);
  EXPECT_EQ(test::run_engine_sim({}).code, -1);
}

TEST_F(DeckTest, StoppedItWritesNothing) {
  const DeckCases cases =
      read_deck_cases(files::read_csv(folder_.file("cases.csv", "altitude_m,mach,delta_isa_k,t40_k\n0,0,0,1400\n")));
  const DeckSink sink{[](std::string_view) {}, [](const DeckCase&, const std::string&) {}, [](std::size_t) {},
                      [] { return true; }};
  EXPECT_THROW(write_deck(Turbofan(jt9d()), cases, 2, sink), std::runtime_error);
}

// The limits of the columns are those of the model: at a limit it accepts the operation, beyond it refuses.
TEST(DeckColumns, HaveTheRangesOfTheModel) {
  const auto accepted = [](const DeckInput& input, double value) {
    Operation operation{.fuel_flow_kg_s = 1.0};
    input.set(operation, value);
    try {
      require_valid(operation);
      intake(jt9d().inlet, operation.flight);
      return true;
    } catch (const std::exception&) {
      return false;
    }
  };
  for (const DeckInput& input : deck_inputs()) {
    if (input.demand) continue;
    const double beyond = 1e-6 * (input.highest - input.lowest);
    EXPECT_TRUE(accepted(input, input.lowest)) << input.name;
    EXPECT_TRUE(accepted(input, input.highest)) << input.name;
    EXPECT_FALSE(accepted(input, input.lowest - beyond)) << input.name;
    EXPECT_FALSE(accepted(input, input.highest + beyond)) << input.name;
  }
}

// Limits as in npss_cases_test.cpp, which explains them: 0.6 % in temperature, pressure and speed.
TEST_F(DeckTest, AgreesWithNpss) {
  std::vector<reference::Case> cases;
  std::string text = "altitude_m,mach,delta_isa_k,fuel_flow_kg_s\n";
  for (const reference::Case& c : reference::npss_points(90.0)) {
    const bool sea_level_static = c.at("alt") == 0.0 && c.at("MN") == 0.0;
    if (!sea_level_static && !(c.at("alt") == 35000.0 && c.at("MN") == 0.8)) continue;
    cases.push_back(c);
    for (const double x : {c.at("alt") * m_per_ft, c.at("MN"), c.at("dTamb") / rankine_per_kelvin})
      text += files::shortest(x) + ",";
    text += files::shortest(c.at("Wfuel") / 3600.0 * kg_per_lbm) + "\n";
  }
  ASSERT_EQ(cases.size(), 4u);
  ASSERT_EQ(deck(text).code, 0);
  const files::CsvTable table = written();
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto expect = [&](const char* ours, double factor, const char* theirs) {
      EXPECT_NEAR(number(table, i, ours) * factor / cases[i].at(theirs), 1.0, 0.006) << ours << " of case " << i;
    };
    expect("tt_24_k", rankine_per_kelvin, "Tt_24");
    expect("tt_30_k", rankine_per_kelvin, "Tt_3");
    expect("tt_40_k", rankine_per_kelvin, "Tt_4");
    expect("pt_24_pa", 1.0 / pa_per_psi, "Pt_24");
    expect("pt_30_pa", 1.0 / pa_per_psi, "Pt_3");
    expect("n1_rpm", 1.0, "LP_N");
    expect("n2_rpm", 1.0, "HP_N");
  }
}

}  // namespace
}  // namespace ehm::engine_sim
