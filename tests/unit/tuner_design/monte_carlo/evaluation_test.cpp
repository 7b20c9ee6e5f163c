// SPDX-License-Identifier: Apache-2.0
// Experiment against theory on the linear truth, and against a wrong theory; the same bytes on any number of threads.

#include "tuner_design/monte_carlo/evaluation.h"

#include <gtest/gtest.h>

#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/design/design_tuner.h"
#include "tuner_design/monte_carlo/finite_window.h"
#include "tuner_design/monte_carlo/kalman_experiment.h"
#include "tuner_design/monte_carlo/map_experiment.h"
#include "tuner_design/print/evaluation_text.h"

namespace ehm::tuner_design {
namespace {

design::Design designed(const linear_model::LinearModel& model, double qh_percent2) {
  design::DesignOptions options;
  options.qh_percent2 = qh_percent2;
  return design_tuner(model, options);
}

EvaluateOptions short_runs() {
  EvaluateOptions options;
  options.runs = 600;
  options.engines = 20000;
  options.seconds = 9.0;
  options.window = 3.0;
  return options;
}

/// Largest difference of a channel or a total from theory, in standard errors.
double off_by(const Experiment& each, const design::ErrorByChannel& theory) {
  const auto channels = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b, const Eigen::VectorXd& error) {
    return (a - b).cwiseQuotient(error).cwiseAbs().maxCoeff();
  };
  return std::max(
      {channels(each.experiment.health, theory.health, each.standard_error.health),
       channels(each.experiment.auxiliary, theory.auxiliary, each.standard_error.auxiliary),
       std::abs(each.experiment.health.sum() - theory.health.sum()) / each.standard_error_of_total.health,
       std::abs(each.experiment.auxiliary.sum() - theory.auxiliary.sum()) / each.standard_error_of_total.auxiliary});
}

void expect_agreement(const linear_model::LinearModel& model, bool process_noise) {
  const design::Design design = designed(model, 1e-4);
  EvaluateOptions options = short_runs();
  options.process_noise = process_noise;
  const Evaluation evaluation = evaluate(design, options);
  ASSERT_EQ(evaluation.experiments.size(), 3U);
  for (const Experiment& each : evaluation.experiments) {
    EXPECT_LT(off_by(each, each.theory), 3.0) << each.estimator;
    EXPECT_EQ(each.without_steady_point, 0U);
  }
  // Without a linearisation error the published intervals are those of this very truth, which moves: 95 %.
  const Experiment& kalman = evaluation.experiments.front();
  EXPECT_EQ(kalman.engines, options.runs);
  if (!process_noise) return;
  const double most = 4.0 * kalman.coverage_standard_error.health.maxCoeff();
  EXPECT_LT((kalman.coverage.health.array() - 0.95).abs().maxCoeff(), most);
  EXPECT_LT((kalman.coverage.auxiliary.array() - 0.95).abs().maxCoeff(), most);
}

TEST(Evaluation, AgreesWithTheoryOnAMadeUpEngine) {
  expect_agreement(test::made_up_model(), false);
  expect_agreement(test::made_up_model(), true);
}

TEST(Evaluation, FliesWithProcessNoiseUnlessToldOtherwise) {
  EXPECT_TRUE(EvaluateOptions{}.process_noise);
  EXPECT_TRUE(KalmanOptions{}.process_noise);
}

TEST(Evaluation, WithoutProcessNoiseInTheModelItChangesNothing) {
  linear_model::LinearModel model = test::made_up_model();
  model.process_noise.setZero();
  const design::Design design = designed(model, 1e-4);
  const Window window = window_of(3.0, 1.0, 0.015);
  const WindowError with = finite_window_error(design, window, true),
                    without = finite_window_error(design, window, false);
  EXPECT_EQ(with.linear.health, without.linear.health) << "to all digits";
  EXPECT_EQ(with.linear.auxiliary, without.linear.auxiliary);
  EXPECT_EQ(settled_error(design, true).health, design.ssee.health);
  EXPECT_TRUE(settled_error(design, false).health.isApprox(design.ssee.health, 1e-12));
}

TEST(Evaluation, AgreesWithTheoryUnderProcessNoise) {
  // So strong that the theory without it is wrong.
  linear_model::LinearModel model = test::made_up_model();
  model.process_noise *= 400.0;
  expect_agreement(model, true);
  const design::Design design = designed(model, 1e-4);
  EvaluateOptions options = short_runs();
  options.process_noise = true;
  options.map = false;
  const Experiment kalman = evaluate(design, options).experiments.front();
  const Window window = window_of(options.seconds, options.window, 0.015);
  EXPECT_GT(off_by(kalman, finite_window_error(design, window, false).linear), 6.0);
}

TEST(Evaluation, AgreesWithTheoryOnTheReferenceEngine) {
  expect_agreement(test::jt9d_cruise(), true);
}

TEST(Evaluation, DisagreesWithTheTheoryOfAnotherQh) {
  const linear_model::LinearModel model = test::made_up_model();
  EvaluateOptions options = short_runs();
  options.map = false;
  options.runs = 3000, options.seconds = 1.5, options.window = 1.0;
  const Experiment kalman = evaluate(designed(model, 1e-4), options).experiments.front();
  EXPECT_LT(off_by(kalman, kalman.theory), 3.0);
  const Window window = window_of(options.seconds, options.window, model.sample_time_s);
  EXPECT_GT(off_by(kalman, finite_window_error(designed(model, 1e-3), window, false).linear), 6.0);
  EXPECT_GT(off_by(kalman, finite_window_error(designed(model, 1e-5), window, false).linear), 6.0);
  EXPECT_GT(off_by(kalman, kalman.settled), 3.0) << "a cold start has not settled after half a second";
}

TEST(Evaluation, MapOnOtherTunersHasItsOwnTheory) {
  const design::Design design = designed(test::made_up_model(), 1e-4);
  test::Random random(4);
  const Truth truth = linear_truth(design);
  const auto results = map_experiment(design, random.normal_matrix(4, 6), truth, {20000, 1, 1}, [](std::size_t) {});
  EXPECT_LT(off_by(results[1], results[1].theory), 3.0);
  EXPECT_GT(results[1].theory.health.sum(), results[0].theory.health.sum());
  EXPECT_GT(off_by(results[1], results[0].theory), 6.0);
}

TEST(Evaluation, IsTheSameOnAnyNumberOfThreads) {
  const design::Design design = designed(test::made_up_model(), 1e-3);
  EvaluateOptions options = short_runs();
  options.runs = 1500;  // more than there are blocks, and no multiple of them
  options.seconds = 0.6, options.window = 0.3;
  options.engines = 3001;
  options.threads = 1;
  const std::string one = evaluation_as_csv(evaluate(design, options), design);
  for (const unsigned threads : {2U, 5U}) {
    options.threads = threads;
    EXPECT_EQ(evaluation_as_csv(evaluate(design, options), design), one) << threads;
  }
  options.seed = 2;
  EXPECT_NE(evaluation_as_csv(evaluate(design, options), design), one);
}

TEST(Evaluation, ReportsItsProgressUpToTheEnd) {
  EvaluateOptions options = short_runs();
  options.runs = 20, options.engines = 500, options.threads = 1;
  double last = 0.0;
  evaluate(designed(test::made_up_model(), 1e-3), options, [&](double share) {
    EXPECT_GE(share, last);
    last = share;
  });
  EXPECT_NEAR(last, 1.0, 1e-9);
}

TEST(Evaluation, RefusesWhatCannotBe) {
  const design::Design design = designed(test::made_up_model(), 1e-3);
  const auto refuses = [&](const auto& change, const std::string& message) {
    EvaluateOptions options;
    change(options);
    try {
      evaluate(design, options);
      FAIL() << "accepted: " << message;
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(error.what(), message);
    }
  };
  refuses([](EvaluateOptions& o) { o.runs = 1; }, "runs is 1; allowed: 2 or more");
  refuses([](EvaluateOptions& o) { o.engines = 0; }, "engines is 0; allowed: 2 or more");
  refuses(
      [](EvaluateOptions& o) { o.nonlinear = true; },
      "nonlinear truth: the design for the engine '' has no operating_point; allowed: a design of what tuner_design "
      "linearise writes");
}

}  // namespace
}  // namespace ehm::tuner_design
