// SPDX-License-Identifier: Apache-2.0
// The 27 linear models of Endurthi's thesis against our engine.

#include "tuner_design/endurthi/linearisation_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "engine_sim/engines/jt9d_engine.h"
#include "engine_sim/linear_model/discretise.h"
#include "tuner_design/endurthi/published.h"
#include "tuner_design/linearise/step_study.h"
#include "tuner_design/print/studies/endurthi_linear_text.h"

namespace ehm::tuner_design::endurthi {
namespace {

const std::vector<StudyPoint>& points() {
  static const std::vector<StudyPoint> both = study_points(engine_sim::jt9d_engine());
  return both;
}

const LinearisationStudy& study() {
  static const LinearisationStudy made = run_linearisation_study({engine_sim::default_engine(), 2});
  return made;
}

TEST(EndurthiModels, TheirDigitsCountInThrees) {
  EXPECT_EQ(model_digits(0), "000");
  EXPECT_EQ(model_digits(15), "120");
  EXPECT_EQ(model_digits(26), "222");
}

TEST(EndurthiModels, APointRestsAndItsChannelsAreThoseOfTheThesis) {
  for (const StudyPoint& point : points()) {
    const Plant& plant = point.plant;
    EXPECT_EQ(plant.states, 3);
    EXPECT_EQ(plant.controls, 3);
    EXPECT_EQ(plant.health, 9);
    EXPECT_EQ(point.sensors(), 11);
    EXPECT_LT(plant.f0.head(3).cwiseAbs().maxCoeff(), 1e-6);
    // the metal is a state and a sensor at once
    EXPECT_EQ(plant.v0(2), point.sensor_trim()(10));
    EXPECT_DOUBLE_EQ(point.noise_sigma(10), point.sensor_trim()(10) / 70.0);
  }
}

TEST(EndurthiModels, UndisturbedTheLoopStaysAtTrim) {
  for (const StudyPoint& point : points()) {
    const Record record = closed_loop(point, Eigen::VectorXd::Zero(3), Eigen::VectorXd::Zero(9), 1.0, 0.01);
    EXPECT_EQ(record.y.cols(), 101);
    EXPECT_LT((point.sensor_trim().cwiseInverse().asDiagonal() * record.y).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_LT(record.u.cwiseAbs().maxCoeff(), 1e-6);
  }
}

TEST(EndurthiModels, AModelMissesNothingOfItself) {
  const StudyPoint& point = points().front();
  const Eigen::MatrixXd tangent = study_steps(point.plant).jacobian;
  const linear_model::LinearModel model = discretise(linear_model_of(point.plant, tangent, 0.01));
  Record record{.step_s = 0.01,
                .x0 = Eigen::VectorXd::Constant(3, 0.5),
                .h = Eigen::VectorXd::Constant(9, -1e-3),
                .u = Eigen::MatrixXd::Constant(3, 50, 1e-3),
                .y = Eigen::MatrixXd(11, 50)};
  Eigen::VectorXd x = record.x0;
  for (Eigen::Index k = 0; k < 50; ++k) {
    record.y.col(k) = model.C * x + model.D * record.u.col(k) + model.M * record.h;
    x = (model.A * x + model.B * record.u.col(k) + model.L * record.h).eval();
  }
  EXPECT_LT(error_of(point.plant, tangent, record, 0.1).average, 1e-11);
  // one percent of every sensor's trim missed, tested with a tenth of a percent
  record.y.colwise() += 0.01 * point.sensor_trim();
  EXPECT_NEAR(error_of(point.plant, tangent, record, 0.1).average, 10.0, 1e-9);
  EXPECT_NEAR(error_of(point.plant, tangent, record, 0.1).final, 10.0, 1e-9);
}

// What a tangent misses is of second order: ten times the perturbation, ten times the error in percent of it.
TEST(EndurthiStudy, TheTangentMissesTheCurvatureOnly) {
  for (const LinearisationPoint& point : study().points) {
    const double small = point.errors[0][0][tangent_model].average, larger = point.errors[0][1][tangent_model].average;
    EXPECT_NEAR(larger / small, 10.0, 0.3) << point.name;
    EXPECT_LT(small, 7.5e-4) << "what the thesis' LIN000 misses";
  }
}

// Why it is the default: a secant is good for the change that it was made with, and 20 times worse than the best for
// another; the tangent is near the best everywhere.
TEST(EndurthiStudy, TheTangentIsNearTheBestInEveryCell) {
  constexpr std::size_t lin212 = 23;
  for (const LinearisationPoint& point : study().points) {
    double tangent = 0.0, secant = 0.0;
    for (const auto& row : point.errors) {
      for (const ModelErrors& errors : row) {
        double best = errors[0].average;
        for (const ModelError& error : errors) best = std::min(best, error.average);
        tangent = std::max(tangent, errors[tangent_model].average / best);
        secant = std::max(secant, errors[lin212].average / best);
      }
    }
    EXPECT_LT(tangent, 3.0) << point.name;
    EXPECT_GT(secant, 20.0) << point.name;
  }
}

TEST(EndurthiStudy, OnSmoothMapsMostModelsCoincideAndMatlabsDoesNotFail) {
  for (const LinearisationPoint& point : study().points) {
    EXPECT_LE(point.groups[0].size(), 8u) << point.name;
    std::size_t members = 0;
    for (const auto& group : point.groups[0]) members += group.size();
    EXPECT_EQ(members, model_count);
    // LIN111 beside LIN110: published 2.6 times as far off
    EXPECT_LT(point.errors[0][0][13].average, 2.2 * point.errors[0][0][12].average);
  }
}

TEST(EndurthiStudy, WithACornerMatlabsMethodFailsAsPublished) {
  for (const LinearisationPoint& point : study().points)
    for (std::size_t model = 0; model < model_count; model += 3) {
      const ModelErrors& errors = point.with_corner;
      EXPECT_GT(errors[model + 1].average, 2.0 * errors[model].average) << point.name << model_digits(model);
      EXPECT_LT(errors[model + 2].average, errors[model].average) << point.name << model_digits(model);
    }
}

TEST(EndurthiStudy, TheSameOnAnyNumberOfThreads) {
  EXPECT_EQ(linearisation_study_csv(run_linearisation_study({engine_sim::default_engine(), 1})),
            linearisation_study_csv(study()));
}

TEST(EndurthiStudy, PrintsOursBesideThePublished) {
  for (int table = 1; table <= 3; ++table) {
    std::ostringstream out;
    print_linearisation_study(study(), table, out);
    EXPECT_THAT(out.str(), ::testing::HasSubstr("published"));
    EXPECT_THAT(out.str(), ::testing::HasSubstr("tangent"));
  }
  EXPECT_EQ(linearisation_study_as_json(study()).at("errors").size(), 2 * (9 + 1) * (model_count + 1));
}

// The averages of tables IV and V are the means of their rows to rounding: no number was misread.
TEST(EndurthiPublished, TheAveragesAreThoseOfTheirRows) {
  for (std::size_t model = 0; model < model_count; ++model) {
    for (const PublishedHealth& row : {published_models[model].unconstrained, published_models[model].constrained}) {
      double sum = 0.0;
      for (std::size_t i = 0; i < 9; ++i) sum += row[i];
      EXPECT_NEAR(sum / 9.0, row.back(), 0.015) << model_digits(model);
    }
  }
}

}  // namespace
}  // namespace ehm::tuner_design::endurthi
