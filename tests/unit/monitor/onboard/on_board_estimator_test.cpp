// SPDX-License-Identifier: Apache-2.0
// The on-board estimator on flights whose truth is not its model: honest, with any sensors, and cold after a model that
// has lost its answer. The same on whole fleets: `tuner_design study flight`.

#include "monitor/onboard/on_board_estimator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/monitor/onboard/on_board_flight.h"

namespace ehm::onboard {
namespace {

using test::OnBoardFlight;

/// Errors in sigmas: of health and auxiliary outputs, the largest of each.
struct Errors {
  double health = 0.0, auxiliary = 0.0;
};
Errors errors_of(const OnBoardFlight& flight) {
  const auto& e = flight.estimator.estimate();
  Errors errors;
  for (std::size_t i = 0; i < flight.sample.health.size(); ++i)
    errors.health = std::max(errors.health,
                             std::abs(e.health(as_index(i)) - flight.sample.health[i]) / e.health_sigma(as_index(i)));
  for (std::size_t i = 0; i < flight.sample.auxiliary.size(); ++i)
    errors.auxiliary = std::max(errors.auxiliary, std::abs(e.auxiliary(as_index(i)) - flight.sample.auxiliary[i]) /
                                                      e.auxiliary_sigma(as_index(i)));
  return errors;
}
double claimed(const OnBoardFlight& flight) {
  return flight.estimator.estimate().health_sigma.squaredNorm() * 1e4;
}

TEST(OnBoardEstimator, LearnsAPerturbedEngineOverAClimbAndKnowsHowWell) {
  OnBoardFlight flight({.seed = 11});
  const double at_first = 4.0 * 10.0;  // ten parameters of 2 % each
  while (flight.time_s() < 1500.0) {
    flight.next();
    ASSERT_TRUE(flight.estimator.estimate().holds) << flight.time_s();
    // 14 channels over 1500 s: four sigmas are not passed by an honest one
    const Errors errors = errors_of(flight);
    ASSERT_LT(errors.health, 4.5) << flight.time_s();
    ASSERT_LT(errors.auxiliary, 5.0) << flight.time_s();
  }
  EXPECT_LT(claimed(flight), 0.3 * at_first);
  EXPECT_TRUE(flight.estimator.estimate().settled);
}

TEST(OnBoardEstimator, InnovationsAreNoLargerThanItStates) {
  OnBoardFlight flight({.seed = 12, .mismatch = {}});
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(7);
  int count = 0;
  while (flight.time_s() < 3000.0) {
    flight.next();
    if (flight.time_s() < 2000.0) continue;
    const auto& innovation = flight.estimator.innovation();
    sum += innovation.value.cwiseAbs2().cwiseQuotient(innovation.variance);
    ++count;
  }
  // 10 000 samples tell a variance to 1.4 %. It may be too large: the rule of the early gain adds (6 % tr P/tr P(0))^2,
  // a third of the noise of the speeds here.
  for (Eigen::Index i = 0; i < sum.size(); ++i) {
    EXPECT_GT(sum(i) / count, 0.6) << i;
    EXPECT_LT(sum(i) / count, 1.05) << i;
  }
}

TEST(OnBoardEstimator, AnySensorMayBeMissingFromTheStart) {
  for (std::size_t missing = 0; missing < 7; ++missing) {
    OnBoardFlight flight({.seed = 20 + missing, .missing = {missing}});
    while (flight.time_s() < 900.0) flight.next();
    const Errors errors = errors_of(flight);
    EXPECT_LT(errors.health, 4.0) << missing;
    EXPECT_LT(errors.auxiliary, 4.0) << missing;
    EXPECT_FALSE(flight.estimator.estimate().sensors[missing]);
  }
}

TEST(OnBoardEstimator, BothSpeedsMayBeMissingFromTheStart) {
  OnBoardFlight flight({.seed = 40, .missing = {0, 1}});
  while (flight.time_s() < 900.0) flight.next();
  EXPECT_LT(errors_of(flight).health, 4.0);
  EXPECT_LT(errors_of(flight).auxiliary, 4.0);
}

TEST(OnBoardEstimator, OnTheGroundAtIdleItFollowsTheSpeedsAndLearnsNothing) {
  OnBoardFlight flight({.seed = 13, .options = {.least_n1 = 0.60}});
  while (flight.time_s() < 200.0) flight.next();
  EXPECT_NEAR(claimed(flight), 40.0, 0.1);
  EXPECT_TRUE(flight.estimator.estimate().health.isZero(0.0));
  EXPECT_LT(std::abs(flight.estimator.innovation().value(0)),
            5.0 * std::sqrt(flight.estimator.innovation().variance(0)));
}

// What the suite of the estimators at a point asks of them (../estimation/estimator_test.cpp).
TEST(OnBoardEstimator, StatesItsCovarianceAndGoesOnFromACorrectedHealth) {
  OnBoardFlight flight({.seed = 15});
  while (flight.time_s() < 700.0) flight.next();
  OnBoardEstimator& estimator = flight.estimator;
  const estimation::Estimate before = estimator.estimate();
  const estimation::HealthCovariance covariance = estimator.health_covariance();
  for (Eigen::Index i = 0; i < before.health.size(); ++i)
    EXPECT_NEAR(std::sqrt(covariance(i, i)), before.health_sigma(i), 1e-12) << i;
  estimation::HealthVector wanted = before.health;
  wanted(4) -= 0.3 * before.health_sigma(4);
  ASSERT_TRUE(estimator.correct_health(wanted));
  EXPECT_LT((estimator.estimate().health - wanted).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_EQ(estimator.estimate().health_sigma, before.health_sigma);
  flight.next();
  EXPECT_TRUE(estimator.estimate().holds);
  EXPECT_LT(estimator.estimate().health(4), before.health(4) - 0.1 * before.health_sigma(4));
  EXPECT_LT(errors_of(flight).health, 4.5);
  EXPECT_LT(errors_of(flight).auxiliary, 5.0);
}

TEST(OnBoardEstimator, ASecondWithoutAnAnswerStartsItCold) {
  OnBoardFlight flight({.seed = 14});
  while (flight.time_s() < 900.0) flight.next();
  const double learned = claimed(flight);
  EXPECT_LT(learned, 20.0);
  estimation::Conditions impossible = flight.now;
  impossible.actuators(0) *= 50.0;
  for (int k = 0; k < 12; ++k) {
    flight.estimator.predict(flight.now, 1);
    flight.estimator.innovate(flight.measured(), impossible);
    flight.estimator.update(flight.fused, 1);
    if (k == 0) {
      EXPECT_FALSE(flight.estimator.estimate().holds);
    }
  }
  EXPECT_NEAR(claimed(flight), 40.0, 1e-9);
  for (int k = 0; k < 100; ++k) flight.next();
  EXPECT_TRUE(flight.estimator.estimate().holds);
  EXPECT_LT(errors_of(flight).health, 4.0);
}

TEST(OnBoardEstimator, AStepOfHealthInCruiseIsFoundNamedAndLearnedAnew) {
  const engine_sim::PlannedChange step{.time_s = 1900.0, .channel = 4, .change = -0.02};
  OnBoardFlight flight({.seed = 17, .health_changes = {step}}),
      deaf({.seed = 17, .health_changes = {step}, .options = {.step_threshold = 1e9}});
  while (flight.time_s() < 1900.0) flight.next(), deaf.next();
  EXPECT_EQ(flight.estimator.steps_found(), 0);
  EXPECT_EQ(flight.estimator.estimate().health, deaf.estimator.estimate().health);
  while (flight.time_s() < 1910.0) flight.next(), deaf.next();
  EXPECT_EQ(flight.estimator.steps_found(), 1);
  EXPECT_EQ(flight.estimator.estimate().stepped, 4);
  EXPECT_LT(flight.estimator.estimate().step, -0.004);  // of -0.02, as far as it was seen when it was found
  EXPECT_GT(flight.estimator.estimate().step, -0.025);
  EXPECT_LT(flight.estimator.estimate().least_step, 0.01);
  while (flight.time_s() < 2500.0) flight.next(), deaf.next();
  EXPECT_EQ(flight.estimator.steps_found(), 1);
  EXPECT_EQ(flight.estimator.estimate().stepped, -1);  // it is known again
  EXPECT_LT(errors_of(flight).health, 4.0);
  EXPECT_GT(errors_of(deaf).health, 6.0);  // a constant that has been learned stays what it was
}

/// Health and build; what was reported wrongly is another error in each flight.
Eigen::VectorXd kept_of(const Learned& learned) {
  constexpr Eigen::Index health_and_build = 10 + 11;
  return learned.value.head(health_and_build);
}

TEST(OnBoardEstimator, BeginsWithWhatAnEarlierFlightHasTaught) {
  OnBoardFlight first({.seed = 18}), second({.seed = 18});
  while (first.time_s() < 1500.0) first.next();
  const Learned learned = first.estimator.learned();
  second.estimator.begin_with(learned, 0.0);
  EXPECT_NEAR(claimed(second), claimed(first), 1e-9);
  EXPECT_EQ(kept_of(second.estimator.learned()), kept_of(learned));
  while (second.time_s() < 1500.0) {
    second.next();
    ASSERT_LT(errors_of(second).health, 5.0) << second.time_s();
  }
  EXPECT_LT(claimed(second), 0.9 * claimed(first));
  second.estimator.reset();
  EXPECT_EQ(kept_of(second.estimator.learned()), kept_of(learned));
  Learned other = learned;
  other.value.conservativeResize(5);
  EXPECT_FALSE(second.estimator.begin_with(other, 0.0));
}

// A monitor that was restarted in flight: what was learned is kept, the metal is in doubt for a while.
TEST(OnBoardEstimator, GoesOnInFlightFromWhatACheckpointHasKept) {
  OnBoardFlight flight({.seed = 18}), cold({.seed = 18});
  while (flight.time_s() < 1500.0) flight.next(), cold.next();
  const double known = claimed(flight);
  estimation::EstimatorState state;
  flight.estimator.save(state);
  flight.estimator.reset();
  cold.estimator.reset();
  ASSERT_TRUE(flight.estimator.restore(state));
  while (flight.time_s() < 1600.0) {
    flight.next(), cold.next();
    ASSERT_LT(errors_of(flight).health, 5.0) << flight.time_s();
  }
  EXPECT_LT(claimed(flight), 1.05 * known);
  EXPECT_GT(claimed(cold), 2.0 * claimed(flight));
  EXPECT_FALSE(flight.estimator.restore({}));
}

// Whoever lands goes on with what is there: nothing jumps, and the next flight's inputs are as uncertain as any.
TEST(OnBoardEstimator, GoesOnFromOneFlightToTheNext) {
  OnBoardFlight flight({.seed = 18});
  while (flight.time_s() < 1500.0) flight.next();
  const Learned before = flight.estimator.learned();
  flight.estimator.next_flight(0.5);
  const Learned after = flight.estimator.learned();
  EXPECT_EQ(after.value, before.value);
  for (Eigen::Index i = 0; i < 10; ++i) EXPECT_NEAR(after.covariance(i, i), before.covariance(i, i) + 0.25, 1e-9) << i;
  EXPECT_NEAR(after.covariance(12, 12), before.covariance(12, 12), 1e-9) << "the build stays as it is known";
  const Eigen::Index inputs = after.value.size() - 1;
  EXPECT_NEAR(after.covariance(inputs, inputs), before.covariance(inputs, inputs) + 1.0, 1e-9);
  flight.next();
  EXPECT_LT(errors_of(flight).health, 5.0);
  flight.estimator.reset();
  EXPECT_EQ(kept_of(flight.estimator.learned()), kept_of(before));
}

TEST(OnBoardEstimator, GapsAreBridgedAndTheSpeedsFoundAgain) {
  OnBoardFlight flight({.seed = 15});
  while (flight.time_s() < 1700.0) flight.next();
  flight.skip(5);
  EXPECT_LT(errors_of(flight).auxiliary, 4.0);
  flight.skip(300);
  for (int k = 0; k < 50; ++k) flight.next();
  EXPECT_LT(errors_of(flight).auxiliary, 4.0);
  EXPECT_LT(errors_of(flight).health, 4.0);
}

TEST(OnBoardEstimator, TheSameSamplesGiveTheSameBitsAndResetForgetsAll) {
  OnBoardFlight a({.seed = 16}), b({.seed = 16});
  for (int k = 0; k < 3000; ++k) a.next(), b.next();
  EXPECT_EQ(a.estimator.estimate().health, b.estimator.estimate().health);
  EXPECT_EQ(a.estimator.estimate().auxiliary_sigma, b.estimator.estimate().auxiliary_sigma);
  a.estimator.reset();
  const auto fresh = b.estimator.clone();
  EXPECT_EQ(a.estimator.estimate().health, fresh->estimate().health);
  EXPECT_EQ(a.estimator.estimate().health_sigma, fresh->estimate().health_sigma);
  EXPECT_FALSE(a.estimator.use({}));
}

TEST(OnBoardModel, RefusesAChannelWithoutSlopesAndReadsTheEngineWithOne) {
  auto engine = std::make_shared<engine_sim::EngineDefinition>(*engine_sim::default_engine());
  engine->channels.auxiliary = {engine_sim::find_output("EGTM")};
  EXPECT_EQ(OnBoardModel(engine, {}).auxiliary()[0].sign, -1.0);
  engine->channels.auxiliary = {engine_sim::find_output("Tm_hpt")};
  EXPECT_THROW(OnBoardModel(engine, {}), std::invalid_argument);
}

}  // namespace
}  // namespace ehm::onboard
