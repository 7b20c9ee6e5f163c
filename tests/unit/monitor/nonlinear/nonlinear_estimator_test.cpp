// SPDX-License-Identifier: Apache-2.0
// What every nonlinear filter on the on-board engine promises as an estimator (monitor/estimation/estimator.h): one
// suite, a row for each. Whole fleets: `tuner_design study family`.

#include "monitor/nonlinear/nonlinear_estimator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>

#include "tests/unit/monitor/nonlinear/cruise_engine.h"

namespace {

using namespace ehm;
using design::NonlinearKind;
using estimation::Estimate;
using estimation::Estimator;
using estimation::SensorMask;
using nonlinear::test::as_filed;
using nonlinear::test::CruiseEngine;

struct Row {
  const char* name;
  NonlinearKind kind;
  bool gaussian;  ///< it holds the whole distribution; a few particles do not
  friend void PrintTo(const Row& row, std::ostream* out) { *out << row.name; }
};

std::unique_ptr<Estimator> make(NonlinearKind kind) {
  monitor::EstimatorOptions options;
  options.particles = 20;
  return design::make_nonlinear_estimator(kind, as_filed(), options);
}

bool same(const Estimate& a, const Estimate& b) {
  return a.health == b.health && a.health_sigma == b.health_sigma && a.auxiliary == b.auxiliary &&
         a.auxiliary_sigma == b.auxiliary_sigma && a.sensors == b.sensors && a.settled == b.settled &&
         a.holds == b.holds;
}

class EveryNonlinearEstimator : public testing::TestWithParam<Row> {
 protected:
  std::unique_ptr<Estimator> estimator_ = make(GetParam().kind);
};

TEST_P(EveryNonlinearEstimator, StartsAtThePriorAndIsAsNewAfterAReset) {
  const Estimate fresh = estimator_->estimate();
  EXPECT_TRUE(fresh.health.isZero());
  for (const double sigma : fresh.health_sigma) EXPECT_NEAR(sigma, 0.02, 1e-12);  // the engine file's
  EXPECT_FALSE(fresh.settled);
  CruiseEngine engine(1);
  engine.fly_for(1.0, *estimator_);
  EXPECT_FALSE(same(estimator_->estimate(), fresh));
  estimator_->widen(3.0);
  estimator_->reset();
  EXPECT_TRUE(same(estimator_->estimate(), fresh));
}

TEST_P(EveryNonlinearEstimator, TheSameSamplesGiveTheSameBitsAndACloneIsANewOne) {
  CruiseEngine engine(2), twin(2);
  engine.fly_for(2.0, *estimator_);
  const auto clone = estimator_->clone();
  EXPECT_TRUE(same(clone->estimate(), make(GetParam().kind)->estimate()));
  twin.fly_for(2.0, *clone);
  EXPECT_TRUE(same(clone->estimate(), estimator_->estimate()));
}

TEST_P(EveryNonlinearEstimator, LearnsAnEngineThatIsItsFile) {
  if (!GetParam().gaussian) GTEST_SKIP() << "20 particles do not fill 12 states";
  double squares = 0.0, claimed = 0.0;
  int covered = 0, judged = 0;
  constexpr int engines = 10;
  for (std::uint64_t seed = 10; seed < 10 + engines; ++seed) {
    CruiseEngine engine(seed);
    estimator_->reset();
    engine.fly_for(15.0, *estimator_);
    const Estimate& e = estimator_->estimate();
    ASSERT_TRUE(e.holds);
    squares += engine.squared_error(*estimator_) / engines;
    claimed += 1e4 * e.health_sigma.squaredNorm() / engines;
    for (std::size_t i = 0; i < engine.sample.health.size(); ++i, ++judged)
      covered += std::abs(e.health(as_index(i)) - engine.sample.health[i]) <= 1.96 * e.health_sigma(as_index(i));
  }
  // ten parameters of 2 %, of which seven sensors leave 4 (10 - 7) = 12 percent^2 (theory.md, section 11)
  EXPECT_LT(squares, 20.0);
  EXPECT_NEAR(claimed, 12.5, 1.5);
  EXPECT_GE(covered, 0.85 * judged);  // of 100, 95 wanted; less is 4 sigma away
}

TEST_P(EveryNonlinearEstimator, WithoutASensorItStaysFiniteAndLessCertain) {
  const auto without = SensorMask(127).reset(3);
  CruiseEngine engine(3), twin(3);
  const auto with_all = estimator_->clone();
  engine.fly_for(3.0, *estimator_, without);
  twin.fly_for(3.0, *with_all);
  const Estimate& estimate = estimator_->estimate();
  EXPECT_EQ(estimate.sensors, without);
  ASSERT_TRUE(estimate.health.allFinite() && estimate.auxiliary.allFinite());
  if (GetParam().gaussian) {
    EXPECT_GT(estimate.health_sigma.squaredNorm(), with_all->estimate().health_sigma.squaredNorm());
  }
  EXPECT_FALSE(estimator_->use({}));
}

TEST_P(EveryNonlinearEstimator, WithoutAnAnswerOfTheEngineItDoesNotHoldAndComesBack) {
  CruiseEngine engine(4);
  engine.fly_for(1.0, *estimator_);
  ASSERT_TRUE(estimator_->estimate().holds);
  const Eigen::VectorXd health = estimator_->estimate().health;
  estimation::Conditions impossible = engine.now;
  impossible.actuators(0) *= 50.0;
  estimator_->predict(engine.now, 1);
  estimator_->innovate(engine.y, impossible);
  estimator_->update(SensorMask(127), 1);
  EXPECT_FALSE(estimator_->estimate().holds);
  EXPECT_EQ(Eigen::VectorXd(estimator_->estimate().health), health);
  engine.fly_for(0.1, *estimator_);
  EXPECT_TRUE(estimator_->estimate().holds);
  // for more than a second: cold
  for (int k = 0; k < 80; ++k) {
    estimator_->predict(engine.now, 1);
    estimator_->innovate(engine.y, impossible);
    estimator_->update(SensorMask(127), 1);
  }
  EXPECT_TRUE(estimator_->estimate().health.isZero());
  engine.fly_for(0.1, *estimator_);
  EXPECT_TRUE(estimator_->estimate().holds);
}

TEST_P(EveryNonlinearEstimator, GoesOnFromWhatASavedStateHasLearned) {
  CruiseEngine engine(5);
  engine.fly_for(2.0, *estimator_);
  estimation::EstimatorState state;
  estimator_->save(state);
  const auto successor = make(GetParam().kind);
  ASSERT_TRUE(successor->restore(state));
  EXPECT_TRUE(successor->estimate().health.isApprox(estimator_->estimate().health, 1e-12));
  EXPECT_TRUE(successor->estimate().health_sigma.isApprox(estimator_->estimate().health_sigma, 1e-9));
  state.learned.value.conservativeResize(3);
  EXPECT_FALSE(successor->restore(state));
  EXPECT_FALSE(successor->restore({}));
}

TEST_P(EveryNonlinearEstimator, ManyLostSamplesAreABridge) {
  CruiseEngine engine(6);
  engine.fly_for(1.0, *estimator_);
  for (int k = 0; k < 30; ++k) engine.next();
  estimator_->predict(engine.before, 31);
  estimator_->innovate(engine.y, engine.now);
  ASSERT_TRUE(estimator_->estimate().holds);
  EXPECT_GT(estimator_->innovation().variance(0), 100.0);  // rpm^2: where the fan is, nobody knows
  estimator_->update(SensorMask(127), 1);
  EXPECT_TRUE(estimator_->estimate().health.allFinite());
}

TEST_P(EveryNonlinearEstimator, IsWidenedAndKnowsWhereTheAtmosphereEnds) {
  CruiseEngine engine(7);
  engine.fly_for(0.5, *estimator_);
  const Estimate before = estimator_->estimate();
  estimator_->widen(4.0);
  EXPECT_TRUE(estimator_->estimate().health_sigma.isApprox(2.0 * before.health_sigma, 1e-12));
  EXPECT_EQ(estimator_->distance(engine.now), 0.0);
  estimation::Conditions beyond = engine.now;
  beyond.flight.altitude_m = 1e6;
  EXPECT_GT(estimator_->distance(beyond), 1.0);
}

INSTANTIATE_TEST_SUITE_P(Table, EveryNonlinearEstimator,
                         testing::Values(Row{"ekf", NonlinearKind::extended, true},
                                         Row{"iekf", NonlinearKind::iterated, true},
                                         Row{"clipped_ekf", NonlinearKind::clipped, true},
                                         Row{"ukf", NonlinearKind::unscented, true},
                                         Row{"particle", NonlinearKind::particle, false},
                                         Row{"ekpf", NonlinearKind::extended_particle, false},
                                         Row{"cekpf", NonlinearKind::boxed_particle, false}),
                         [](const auto& row) { return std::string(row.param.name); });

}  // namespace
