// SPDX-License-Identifier: Apache-2.0
// Users' matrices through the commands: the same engine as JSON, MATLAB file and CSV folder gives the same design.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/model_file.h"
#include "monitor/design/design_file.h"
#include "tests/temporary_folder.h"
#include "tests/unit/tuner_design/model_files.h"
#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/cli/commands.h"

namespace ehm::tuner_design {
namespace {

using linear_model::LinearModel;
using ::testing::HasSubstr;

struct Result {
  int code;
  std::string out, err;
  [[nodiscard]] nlohmann::json json() const { return nlohmann::json::parse(out); }
};

Result run(std::vector<std::string> arguments) {
  std::vector<const char*> argv{"tuner_design"};
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  std::ostringstream out, err;
  const int code = run_tuner_design(static_cast<int>(argv.size()), argv.data(), out, err);
  return {code, out.str(), err.str()};
}

class ImportCommand : public testing::Test {
 protected:
  /// The model as JSON, as MATLAB file, as CSV folder.
  /// A list of candidates is longer than what write_model writes: the others are put behind by hand.
  void write_json(LinearModel model) {
    const std::size_t most = linear_model::max_sensors, all = model.sensors.size();
    const LinearModel whole = model;
    if (all > most) {
      model.sensors.resize(most);
      for (Eigen::MatrixXd* matrix : {&model.C, &model.D, &model.M}) matrix->conservativeResize(most, Eigen::NoChange);
      model.sensor_noise_sigma.conservativeResize(most);
    }
    linear_model::write_model(model, folder_.path("model.json"));
    if (all <= most) return;
    nlohmann::json json = nlohmann::json::parse(folder_.content("model.json"));
    for (std::size_t i = most; i < all; ++i) {
      const auto at = as_index(i);
      json["sensors"].push_back({{"name", whole.sensors[i].name},
                                 {"unit", whole.sensors[i].unit},
                                 {"trim", whole.sensors[i].trim},
                                 {"noise_sigma", whole.sensor_noise_sigma(at)}});
      for (const auto& [name, matrix] : {std::pair{"C", &whole.C}, {"D", &whole.D}, {"M", &whole.M}}) {
        const Eigen::RowVectorXd row = matrix->row(at);
        json[name].push_back(std::vector<double>(row.begin(), row.end()));
      }
    }
    folder_.file("model.json", json.dump());
  }

  std::vector<std::string> forms(const LinearModel& model) {
    write_json(model);
    {
      test::MatWriter mat(folder_.path("model.mat"));
      test::write_all(mat, model);
    }
    test::write_csv_folder(folder_.path("csv"), model);
    return {folder_.path("model.json"), folder_.path("model.mat"), folder_.path("csv")};
  }

  /// check, import and design of all three forms agree to the last bit; returns what design printed.
  nlohmann::json expect_agreement(const LinearModel& model) {
    const std::vector<std::string> paths = forms(model);
    const Result check = run({"check", paths[0], "--json"});
    const Result design = run({"design", "--model", paths[0], "--out", folder_.path("d.json"), "--json"});
    EXPECT_EQ(check.code, 0) << check.err;
    EXPECT_EQ(design.code, 0) << design.err;
    for (const std::string& path : {paths[1], paths[2]}) {
      SCOPED_TRACE(path);
      const Result other = run({"check", path, "--json"});
      EXPECT_EQ(other.code, 0) << other.err;
      EXPECT_EQ(other.json().at("hash"), check.json().at("hash"));
      EXPECT_TRUE(other.json().at("assumed").empty());
      EXPECT_EQ(run({"import", path, "--out", folder_.path("imported.json"), "--quiet"}).code, 0);
      EXPECT_EQ(folder_.content("imported.json"), folder_.content("model.json"));
      EXPECT_EQ(run({"design", "--model", path, "--out", folder_.path("other.json"), "--json"}).out, design.out);
      EXPECT_EQ(folder_.content("other.json"), folder_.content("d.json"));
    }
    return design.json();
  }

  test::TemporaryFolder folder_;
};

TEST_F(ImportCommand, AMadeUpEngineInEveryForm) {
  EXPECT_EQ(expect_agreement(test::made_up_model()).at("tuners"), 4);
}

TEST_F(ImportCommand, TheJt9dInEveryForm) {
  const nlohmann::json design = expect_agreement(test::jt9d_cruise());
  // full MAP and Bayes limit: theory.md, section 5
  EXPECT_NEAR(design.at("full_map_health").at("total"), 19.717, 5e-4);
  EXPECT_NEAR(design.at("bayes_limit_health").at("total"), 12.000, 5e-4);
}

TEST_F(ImportCommand, TheMapssInEveryFormWithAndWithoutReduction) {
  const auto full = test::mapss(), few = test::mapss({0, 1, 2, 4, 6, 8});
  if (!full) GTEST_SKIP() << test::no_reference;
  const nlohmann::json none = expect_agreement(*full);
  EXPECT_EQ(none.at("reduction"), "none, V = I: at least as many sensors as health parameters");
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t j = 0; j < 8; ++j) EXPECT_EQ(none.at("row_space")[i][j], i == j ? 1.0 : 0.0);
  }
  EXPECT_EQ(expect_agreement(*few).at("tuners"), 6);
}

/// One state, one sensor, two health parameters, nothing else.
std::string bare_matrices(const test::TemporaryFolder& folder, double a) {
  test::MatWriter mat(folder.path("bare.mat"));
  mat.number("A", a);
  mat.numbers("L", Eigen::RowVector2d(0.1, 0.2));
  mat.number("C", 1.0);
  mat.numbers("M", Eigen::RowVector2d(0.0, 0.0));
  return folder.path("bare.mat");
}

TEST_F(ImportCommand, SaysWhatItIsHowItIsScaledAndWhatWasAssumed) {
  const std::string path = bare_matrices(folder_, -2.0), out = folder_.path("m.json");
  const Result table = run({"import", path, "--out", out, "--sample-time", "0.02", "--sensor-noise", "0.25"});
  ASSERT_EQ(table.code, 0) << table.err;
  for (const char* text : {"linear model (MATLAB v5 file), bare", "continuous, sample 0.02 s",
                           "1 states, 0 controls, 2 health, 1 sensors, 0 auxiliary", "percent -> percent",
                           "assumed        h1, h2: fleet's sigma 2 %", "written to "}) {
    EXPECT_THAT(table.out, HasSubstr(text));
  }
  EXPECT_EQ(linear_model::read_model(out).sensor_noise_sigma(0), 0.25);
  const nlohmann::json json = run({"import", path, "--out", out, "--sample-time", "0.02", "--json"}).json();
  EXPECT_EQ(json.at("file"), out);
  EXPECT_EQ(json.at("scaling").size(), 4U);
  EXPECT_EQ(json.at("scaling")[3].at("scaled_unit"), "percent");
  EXPECT_EQ(json.at("assumed").size(), 10U) << "names and units of x, y, h, time, three sigmas, and the process noise";
}

TEST_F(ImportCommand, WhatNoDesignCanBeMadeOfIsRefusedAndNothingWritten) {
  const std::string out = folder_.path("m.json");
  const Result unstable = run({"import", bare_matrices(folder_, 0.5), "--out", out, "--sample-time", "0.02"});
  EXPECT_EQ(unstable.code, 2);
  EXPECT_THAT(unstable.err, HasSubstr("bare.mat: A is unstable: its eigenvalue 0.5 does not decay"));
  LinearModel blind = test::made_up_model();
  blind.C.setZero();
  blind.M.setZero();
  for (const std::string& path : forms(blind)) {
    const Result result = run({"import", path, "--out", out});
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.err, HasSubstr(path + ": no sensor sees anything of health in the steady state"));
  }
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(ImportCommand, RepeatedAndBlindSensorsAreNamed) {
  LinearModel model = test::made_up_model();
  for (Eigen::MatrixXd* matrix : {&model.C, &model.M}) {
    matrix->row(3) = matrix->row(2);
    matrix->row(1).setZero();
  }
  for (const std::string& path : forms(model)) {
    const Result check = run({"check", path});
    EXPECT_EQ(check.code, 0) << check.err;
    EXPECT_THAT(check.out, HasSubstr("2 combinations of health are seen, of 4"));
    EXPECT_THAT(check.out, HasSubstr("N2 sees nothing of health in the steady state; no design uses it"));
    const Result design = run({"design", "--model", path, "--out", folder_.path("d.json")});
    EXPECT_EQ(design.code, 0) << design.err;
    EXPECT_THAT(design.out, HasSubstr("2 tuners"));
    EXPECT_THAT(design.out, HasSubstr("N2 sees nothing of health"));
  }
}

TEST_F(ImportCommand, SensorsTakesTwentyCandidatesInEveryForm) {
  for (const std::string& path : forms(test::made_up_model(20, 6))) {
    const Result result = run({"sensors", path, "--max-sensors", "1", "--json"});
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(result.json().at("sets"), 20);
  }
  for (const std::string& path : forms(test::made_up_model(21, 6))) {
    const Result result = run({"sensors", path, "--max-sensors", "1"});
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.err, HasSubstr("1 to 20 channels"));
  }
}

TEST_F(ImportCommand, OptionsForWhatTheFileStatesAreRefused) {
  for (const std::string& path : forms(test::made_up_model())) {
    for (const char* option : {"--sample-time", "--health-sigma", "--sensor-noise", "--process-noise"}) {
      const Result result = run({"check", path, option, "0.02"});
      EXPECT_EQ(result.code, 2) << path << option;
      EXPECT_THAT(result.err, HasSubstr(option));
    }
  }
  const std::string path = bare_matrices(folder_, -2.0);
  for (const char* value : {"0", "nan", "-1", "fast", "11"})
    EXPECT_THAT(run({"check", path, "--sample-time", value}).err, HasSubstr("is not a number from 0.0001 to 10.0"))
        << value;
}

TEST_F(ImportCommand, ADesignOrOneMatrixIsNoModel) {
  const std::string design = folder_.path("d.json");
  ASSERT_EQ(run({"design", "--model", forms(test::made_up_model())[0], "--out", design, "--quiet"}).code, 0);
  EXPECT_THAT(run({"import", design, "--out", folder_.path("m.json")}).err, HasSubstr("d.json: is a design"));
  EXPECT_THAT(run({"check", folder_.path("csv/A.csv")}).err, HasSubstr("A.csv: is one matrix; allowed: a folder"));
}

}  // namespace
}  // namespace ehm::tuner_design
