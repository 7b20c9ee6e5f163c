// SPDX-License-Identifier: Apache-2.0
// The command line: exit codes 0, 1, 2 and what is printed where.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "engine_sim/linear_model/model_file.h"
#include "monitor/design/design_file.h"
#include "tests/unit/tuner_design/cli/run_command.h"
#include "tests/unit/tuner_design/test_models.h"

namespace ehm::tuner_design {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

using Result = test::CommandResult;
constexpr auto& run = test::run_command;

std::string model_on_disk() {
  const std::string path = test::temporary_path("model.json");
  linear_model::write_model(test::made_up_model(), path);
  return path;
}

TEST(Command, DesignPrintsOneJsonObjectAndWritesTheFile) {
  const std::string out = test::temporary_path("design.json");
  const Result result = run({"design", "--model", model_on_disk(), "--out", out, "--qh", "1e-4", "--json"});
  ASSERT_EQ(result.code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  const design::Design design = design::read_design(out);
  EXPECT_EQ(json.at("hash"), design.hash);
  EXPECT_EQ(design.options.qh_percent2, 1e-4);
  EXPECT_EQ(json.at("ssee_health").at("total").get<double>(), design.ssee.health.sum());
  EXPECT_THAT(run({"check", out}).out, HasSubstr(design.hash));
}

TEST(Command, AnEnvelopeIsADesignThatHasASchedule) {
  const std::string out = test::temporary_path("envelope.json");
  const Result result = run({"envelope", "--nodes", "60", "--fleet", "20", "--out", out});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("n1_corrected_rpm"));
  EXPECT_TRUE(design::read_design(out).schedule.has_value());
  EXPECT_EQ(run({"envelope", "--variables", "mach", "--out", out}).code, 2);
  const Result lone = run({"envelope", "--models", model_on_disk(), "--out", out});
  EXPECT_EQ(lone.code, 2);
  EXPECT_THAT(lone.err, HasSubstr("two models or more"));
  EXPECT_THAT(run({"envelope", "--nodes", "5", "--out", out}).err, HasSubstr("--nodes"));
}

std::string design_on_disk() {
  const std::string path = test::temporary_path("evaluated_design.json");
  EXPECT_EQ(run({"design", "--model", model_on_disk(), "--out", path, "--qh", "1e-3", "--quiet"}).code, 0);
  return path;
}

TEST(Command, EvaluatePrintsTheSameNumbersAsTableJsonAndCsv) {
  const std::string csv = test::temporary_path("evaluation.csv");
  std::vector<std::string> arguments{"evaluate", design_on_disk(), "--runs", "40",    "--engines", "500", "--seconds",
                                     "1.5",      "--window",       "0.6",    "--csv", csv};
  const Result table = run(arguments);
  ASSERT_EQ(table.code, 0) << table.err;
  EXPECT_THAT(table.out, HasSubstr("Truth: the design's own linear model, with process noise w"));
  arguments.push_back("--no-process-noise");
  EXPECT_THAT(run(arguments).out, HasSubstr("Truth: the design's own linear model, without process noise"));
  arguments.pop_back();
  arguments.push_back("--json");
  const auto json = nlohmann::json::parse(run(arguments).out);
  ASSERT_EQ(json.at("experiments").size(), 3U);
  const auto& kalman = json.at("experiments")[0];
  EXPECT_EQ(kalman.at("estimator"), "Kalman filter");
  EXPECT_EQ(kalman.at("engines"), 40);
  const auto& total = kalman.at("health").at("total");
  const double off = (total.at("experiment").get<double>() - total.at("theory").get<double>()) /
                     total.at("standard_error").get<double>();
  EXPECT_NEAR(total.at("off_by").get<double>(), off, 1e-12);
  std::ifstream stream(csv);
  std::string head, first;
  std::getline(stream, head), std::getline(stream, first);
  EXPECT_THAT(head, StartsWith("estimator,truth,channel,"));
  EXPECT_THAT(first, StartsWith("\"Kalman filter\",linear,h0,percent,"));
}

TEST(Command, EvaluateTellsWhatItCannotFly) {
  const std::string file = design_on_disk();
  const Result nonlinear = run({"evaluate", file, "--truth", "nonlinear"});
  EXPECT_EQ(nonlinear.code, 2);
  EXPECT_THAT(nonlinear.err,
              HasSubstr(file + ": nonlinear truth: the design for the engine '' has no operating_point"));
  EXPECT_TRUE(nonlinear.out.empty());
  const Result window = run({"evaluate", file, "--seconds", "5", "--window", "6"});
  EXPECT_EQ(window.code, 2);
  EXPECT_THAT(window.err, HasSubstr("a window of 6 s at the end of a run of 5 s; allowed: "));
  EXPECT_EQ(run({"evaluate", file, "--runs", "1"}).code, 2);
  EXPECT_EQ(run({"evaluate", file, "--truth", "all"}).code, 2);
  const Result seed = run({"evaluate", file, "--seed", "-1"});
  EXPECT_EQ(seed.code, 2);
  EXPECT_THAT(seed.err, HasSubstr("'-1' is not a whole number from 0 to 18446744073709551615"));
  EXPECT_EQ(run({"evaluate", model_on_disk()}).code, 2) << "a model is no design";
}

TEST(Command, DesignIsDeterministic) {
  const std::string model = model_on_disk();
  const Result a = run({"design", "--model", model, "--out", test::temporary_path("a.json"), "--json"});
  const Result b = run({"design", "--model", model, "--out", test::temporary_path("b.json"), "--json"});
  EXPECT_EQ(a.out, b.out);
}

TEST(Command, DesignTableNamesEveryChannel) {
  const Result result = run({"design", "--model", model_on_disk(), "--out", test::temporary_path("t.json")});
  ASSERT_EQ(result.code, 0) << result.err;
  for (const char* text : {"T40", "Fn", "h5", "search for the least error of the Kalman filter",
                           "Certificate: at an optimum", "without sensor", "slowest time constant"}) {
    EXPECT_THAT(result.out, HasSubstr(text));
  }
}

TEST(Command, CheckOfAModelSaysWhatItIs) {
  const Result result = run({"check", model_on_disk(), "--json"});
  ASSERT_EQ(result.code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json.at("kind"), "linear model");
  EXPECT_EQ(json.at("health"), 6);
  EXPECT_EQ(json.at("rank"), 4);
  EXPECT_TRUE(json.at("observable").get<bool>());
  EXPECT_EQ(json.at("hash").get<std::string>().size(), 64U);
}

TEST(Command, WrongFilesExitWithTwoAndName) {
  const Result absent = run({"check", "/nonexistent/model.json"});
  EXPECT_EQ(absent.code, 2);
  EXPECT_EQ(absent.err, "tuner_design: /nonexistent/model.json: no such file. Check the path.\n");

  linear_model::LinearModel blind = test::made_up_model();
  for (Eigen::MatrixXd* matrix : {&blind.L, &blind.M}) matrix->setZero();
  const std::string path = test::temporary_path("blind.json");
  linear_model::write_model(blind, path);
  for (const auto& arguments : {std::vector<std::string>{"check", path},
                                {"design", "--model", path, "--out", test::temporary_path("blind_design.json")}}) {
    const Result result = run(arguments);
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.err,
                StartsWith("tuner_design: " + path + ": no sensor sees anything of health in the steady state"));
  }
  EXPECT_FALSE(std::filesystem::exists(test::temporary_path("blind_design.json")));

  const Result folder = run({"design", "--model", model_on_disk(), "--out", "/nonexistent/design.json"});
  EXPECT_EQ(folder.code, 2);
  EXPECT_THAT(folder.err, HasSubstr("/nonexistent/design.json: cannot be written: No such file or directory"));
}

TEST(Command, WrongUsageExitsWithTwo) {
  EXPECT_EQ(run({}).code, 2);
  EXPECT_EQ(run({"fly"}).code, 2);
  EXPECT_THAT(
      run({"desing"}).err,
      StartsWith("tuner_design: unknown command 'desing'; did you mean design? Allowed are linearise, import, "));
  const Result option = run({"design", "--modle", "m.json", "--out", "d.json"});  // and --model is missing
  EXPECT_EQ(option.code, 2);
  EXPECT_EQ(option.err,
            "tuner_design design: unknown option --modle; did you mean --model? See tuner_design design --help\n");
  EXPECT_EQ(run({"design", "--model", "m", "--out", "d", "--qh", "1e6"}).code, 2);
  EXPECT_EQ(run({"design"}).code, 2);
  for (const char* qh : {"-1", "0", "nan", "inf", "fast"}) {
    const Result result = run({"design", "--model", model_on_disk(), "--out", "d.json", "--qh", qh});
    EXPECT_EQ(result.code, 2) << qh;
    EXPECT_THAT(result.err, HasSubstr(qh));
  }
  EXPECT_EQ(run({"linearise", "--out", "m.json", "--n1-rpm", "3600", "--t40-k", "1300"}).code, 2);
  EXPECT_EQ(run({"linearise", "--out", "m.json", "--health", "wing_efficiency=-0.02"}).code, 2);
  EXPECT_EQ(run({"linearise", "--out", "m.json", "--health", "hpc_efficiency"}).code, 2);
}

TEST(Command, LinearisesEachBlockByItsOwnMethod) {
  const std::string out = test::temporary_path("blocks.json");
  const Result mixed = run({"linearise", "--out", out, "--fleet", "0", "--method", "perturbation", "--health-method",
                            "steady-state", "--perturbation", "0.01", "--central"});
  ASSERT_EQ(mixed.code, 0) << mixed.err;
  EXPECT_THAT(mixed.out, HasSubstr("states perturbation, controls perturbation, health steady-state"));
  EXPECT_EQ(linear_model::read_model(out).health.size(), 10u);
  EXPECT_THAT(run({"linearise", "--out", out, "--fleet", "0"}).out, HasSubstr(", tangent: linear model written"));
}

TEST(Command, AMethodThatDoesNotGoIsRefusedByName) {
  const Result beside = run({"linearise", "--out", "m.json", "--method", "fleet", "--states-method", "linmod"});
  EXPECT_EQ(beside.code, 2);
  EXPECT_THAT(beside.err, HasSubstr("--states-method"));
  EXPECT_THAT(beside.err, HasSubstr("--method fleet"));
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{"--method", "matlab"},
                                                {"--controls-method", "fleet"},
                                                {"--perturbation", "0"},
                                                {"--perturbation", "20"},
                                                {"--response-s", "0"}}) {
    const Result result = run({"linearise", "--out", "m.json", wrong[0], wrong[1]});
    EXPECT_EQ(result.code, 2) << wrong[0];
    EXPECT_THAT(result.err, HasSubstr(wrong[0]));
  }
}

TEST(Command, TheStudyOfLinearModelsPrintsAndWritesItsTable) {
  const std::string csv = test::temporary_path("endurthi.csv");
  const Result result = run({"study", "endurthi-3", "--csv", csv});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("LIN222          7.48      0.53"));  // as published
  EXPECT_TRUE(std::filesystem::exists(csv));
  EXPECT_EQ(run({"study", "endurthi-6"}).code, 2);
}

TEST(Command, HelpAndVersionExitWithZero) {
  const Result help = run({"--help"});
  EXPECT_EQ(help.code, 0);
  EXPECT_THAT(help.out, HasSubstr("Exit codes: 0 done"));
  for (const char* command :
       {"linearise", "import", "design", "sweep", "baselines", "sensors", "evaluate", "study", "check"}) {
    EXPECT_THAT(help.out, HasSubstr(command));
    EXPECT_EQ(run({command, "--help"}).code, 0);
  }
  const Result version = run({"--version"});
  EXPECT_EQ(version.code, 0);
  EXPECT_THAT(version.out, StartsWith("tuner_design 0."));
}

}  // namespace
}  // namespace ehm::tuner_design
