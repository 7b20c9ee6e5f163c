// SPDX-License-Identifier: Apache-2.0
// MATLAB files: every form that MATLAB writes a matrix or a text in, and what is assumed where it says nothing.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/tuner_design/import/least_mat.h"

namespace ehm::tuner_design {
namespace {

using linear_model::LinearModel;
using ::testing::IsEmpty;

void expect_same(const LinearModel& a, const LinearModel& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.discrete, b.discrete);
  EXPECT_EQ(a.sample_time_s, b.sample_time_s);
  EXPECT_EQ(a.A, b.A);
  EXPECT_EQ(a.M, b.M);
  EXPECT_EQ(a.G, b.G);
  EXPECT_EQ(a.process_noise, b.process_noise);
  EXPECT_EQ(a.health_sigma, b.health_sigma);
  EXPECT_EQ(a.sensor_noise_sigma, b.sensor_noise_sigma);
  ASSERT_EQ(a.sensors.size(), b.sensors.size());
  for (std::size_t i = 0; i < a.sensors.size(); ++i) {
    EXPECT_EQ(a.sensors[i].name, b.sensors[i].name);
    EXPECT_EQ(a.sensors[i].unit, b.sensors[i].unit);
    EXPECT_EQ(a.sensors[i].trim, b.sensors[i].trim);
  }
}

TEST(ImportMat, AFullModelIsReadToTheLastBit) {
  const LinearModel model = test::made_up_model();
  const ImportedModel plain = import([&](MatWriter& mat) { test::write_all(mat, model); });
  expect_same(plain.model, model);
  EXPECT_THAT(plain.assumed, IsEmpty());
  test::compress(mat_path());
  expect_same(import_model(mat_path(), {}).model, model);
}

TEST(ImportMat, AStructureHoldsAModelToo) {
  const LinearModel model = test::made_up_model();
  const ImportedModel imported = import([&](MatWriter& mat) {
    mat.number("unrelated", 3.0);
    mat.begin_structure("cruise");
    test::write_all(mat, model);
    mat.text("remark", "of no concern");
  });
  expect_same(imported.model, model);
  EXPECT_THAT(imported.assumed, testing::ElementsAre("not part of a model, ignored: remark, unrelated"));
}

TEST(ImportMat, EveryFormOfAMatrixAndOfNames) {
  const Least least;
  const ImportedModel imported = import([&](MatWriter& mat) {
    mat.sparse("A", least.A);
    mat.numbers("L", least.L);
    mat.complex("C", least.C, Eigen::MatrixXd::Zero(2, 1));
    mat.sparse("M", least.M);
    mat.int32("sensor_trim", Eigen::RowVector2i(400, -80));
    mat.texts("sensor_names", {"T3", "speed"});
    mat.cells("health_names", {"a", "b", "c"}, true);
    mat.number("health_sigma", 0.03);
    mat.number("R", 0.25);
    mat.number("Q", 1e-4);
    mat.numbers("B", Eigen::MatrixXd(0, 0));
    mat.numbers("F", Eigen::MatrixXd(0, 1));
    mat.number("Ts", 0.02);
  });
  EXPECT_EQ(imported.model.A, least.A);
  EXPECT_EQ(imported.model.C, least.C);
  EXPECT_EQ(imported.model.M, least.M);
  EXPECT_EQ(imported.model.sensors[1].trim, -80.0);
  EXPECT_EQ(imported.model.sensors[0].name, "T3") << "blanks that fill a character matrix are no part of the name";
  EXPECT_EQ(imported.model.health[2].name, "c");
  EXPECT_EQ(imported.model.health_sigma, Eigen::Vector3d(0.03, 0.03, 0.03));
  EXPECT_EQ(imported.model.sensor_noise_sigma, Eigen::Vector2d(0.5, 0.5));
  EXPECT_EQ(imported.model.process_noise(0, 0), 1e-4);
  EXPECT_TRUE(imported.model.controls.empty() && imported.model.auxiliary.empty());
}

TEST(ImportMat, TheLeastModelIsInPercentAndSaysSo) {
  const ImportedModel imported = import(write_least);
  const LinearModel& model = imported.model;
  EXPECT_EQ(model.name, "model") << "after the file";
  EXPECT_EQ(model.sensors[1].name, "y2");
  EXPECT_EQ(model.sensors[1].unit, "percent");
  EXPECT_EQ(model.health[0].unit, "percent");
  EXPECT_EQ(model.health_sigma, Eigen::Vector3d(2.0, 2.0, 2.0));
  EXPECT_EQ(model.sensor_noise_sigma, Eigen::Vector2d(0.5, 0.5));
  EXPECT_EQ(model.process_noise(0, 0), 0.01 * 0.01);
  EXPECT_THAT(
      imported.assumed,
      testing::ElementsAre(
          "x1: named so, since state_names is not stated",
          "x1: in percent of trim already, since neither trim nor unit is stated",
          "y1, y2: named so, since sensor_names is not stated",
          "y1, y2: in percent of trim already, since neither trim nor unit is stated",
          "h1, h2, h3: named so, since health_names is not stated",
          "h1, h2, h3: columns of L, M, N are per percent, as the sensors are, since health_units is not stated",
          "h1, h2, h3: fleet's sigma 2 %, since health_sigma is not stated (--health-sigma)",
          "y1, y2: noise sigma 0.5 % of trim, since sensor_noise_sigma is not stated (--sensor-noise)",
          "process noise of the states: sigma 0.01 % of trim per sample, since Q is not stated (--process-noise)"));
}

TEST(ImportMat, OptionsStandInForWhatIsNotStated) {
  const ImportedModel imported = import(
      [](MatWriter& mat) {
        const Least least;
        mat.numbers("A", -least.A);
        mat.numbers("L", least.L);
        mat.numbers("C", least.C);
        mat.numbers("M", least.M);
        mat.numbers("sensor_trim", Eigen::Vector2d(400.0, 50.0));
        mat.numbers("sensor_resolution", Eigen::Vector2d(2.0, 0.0));
      },
      {0.025, 1.5, 0.4, 0.02});
  EXPECT_FALSE(imported.model.discrete);
  EXPECT_EQ(imported.model.sample_time_s, 0.025);
  EXPECT_EQ(imported.model.health_sigma(0), 0.015) << "fractions, since the sensors are not in percent";
  EXPECT_DOUBLE_EQ(imported.model.sensor_noise_sigma(0), std::sqrt(1.6 * 1.6 + 4.0 / 12.0)) << "rounded to 2";
  EXPECT_DOUBLE_EQ(imported.model.sensor_noise_sigma(1), 0.2);
  EXPECT_DOUBLE_EQ(imported.model.process_noise(0, 0), 4e-4) << "the state is in percent";
  const std::string contradiction = refusal([](MatWriter& mat) { Least().write(mat); }, {0.02, {}, {}, {}});
  EXPECT_EQ(contradiction,
            ": states the sample time, so that --sample-time would do nothing; allowed: one of the two. Remove one.");
}

}  // namespace
}  // namespace ehm::tuner_design
