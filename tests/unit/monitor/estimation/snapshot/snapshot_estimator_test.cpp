// SPDX-License-Identifier: Apache-2.0
// What the estimators on snapshots promise beside the suite of all of them (../estimator_test.cpp): actuators are taken
// out, a sample without readings has no answer, and which of the three knows more.

#include "monitor/estimation/snapshot/snapshot_estimator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "deploy/runtime/numbers/index.h"
#include "monitor/design/make_estimator.h"
#include "tests/unit/monitor/cycle/flight.h"

namespace {

using namespace ehm;
using estimation::Conditions;
using estimation::Estimate;
using estimation::Estimator;
using estimation::SensorMask;

constexpr int sensors = 7, health = 10;
constexpr std::array names{"map", "wls", "rls"};

std::unique_ptr<Estimator> make(const std::string& name, double memory_s = 3600.0) {
  monitor::EstimatorOptions options;
  options.memory_s = memory_s;
  return design::make_estimator(name, *test::made_up_design(), options, {});
}

SensorMask all_sensors() {
  return SensorMask((1u << sensors) - 1);
}

test::Flight some_engine(std::uint64_t seed) {
  test::Random random(3000 + seed);
  const auto& model = test::made_up_design()->model;
  return {model, model.health_sigma.cwiseProduct(random.normal_vector(health)), seed};
}

/// Flies one sample; `before` are the conditions of the last one.
void fly(Estimator& estimator, test::Flight& flight, Conditions& before, SensorMask fused = all_sensors(),
         std::int64_t hold = 1) {
  const monitor::Sample sample = flight.next();
  Conditions now{sample.flight, estimation::ActuatorVector(1)};
  now.actuators(0) = sample.actuator[0];
  estimation::SensorVector y(sensors);
  for (int i = 0; i < sensors; ++i) y(i) = sample.sensor[as_size(i)];
  if (before.actuators.size() == 0) before = now;
  estimator.use(all_sensors());
  estimator.predict(before, 1);
  before = now;
  estimator.innovate(y, now);
  estimator.update(fused, hold);
}

TEST(SnapshotEstimators, WhatTheActuatorsDoIsTakenOutOfEverySample) {
  for (const char* name : names) {
    SCOPED_TRACE(name);
    auto flight = some_engine(1), still = some_engine(1);
    const auto moved = make(name), other = make(name);
    Conditions before, before_still;
    for (int k = 0; k < 400; ++k) {
      flight.set_actuator(k < 100 ? 0.0 : 0.05 * std::sin(0.02 * k));
      const Eigen::VectorXd z = flight.auxiliary(), z_still = still.auxiliary();
      fly(*moved, flight, before);
      fly(*other, still, before_still);
      const Eigen::VectorXd z_moved = moved->estimate().auxiliary - other->estimate().auxiliary;
      EXPECT_TRUE(moved->estimate().health.isApprox(other->estimate().health, 1e-7)) << k;
      EXPECT_LT((z_moved - (z - z_still)).norm(), 1e-7 * z.norm()) << k;
    }
  }
}

TEST(SnapshotEstimators, TheFirstSampleIsOfAnEngineInBalanceAtItsActuators) {
  for (const char* name : names) {
    SCOPED_TRACE(name);
    auto flight = some_engine(2), still = some_engine(2);
    flight.set_actuator(0.04);
    for (int k = 0; k < 3000; ++k) {
      flight.next();
      still.next();
    }
    const auto off_trim = make(name), at_trim = make(name);
    Conditions before, before_still;
    fly(*off_trim, flight, before);
    fly(*at_trim, still, before_still);
    EXPECT_TRUE(off_trim->estimate().health.isApprox(at_trim->estimate().health, 1e-7));
  }
}

TEST(SnapshotEstimators, ASampleWithoutReadingsIsNoAnswerUnlessTheyAreHeldThatLong) {
  for (const char* name : names) {
    SCOPED_TRACE(name);
    const bool has_memory = std::string(name) == "rls";
    auto flight = some_engine(3);
    const auto estimator = make(name);
    Conditions before;
    fly(*estimator, flight, before, {});
    EXPECT_EQ(estimator->estimate().holds, has_memory) << "nothing has been seen yet";
    fly(*estimator, flight, before);
    EXPECT_TRUE(estimator->estimate().holds);
    const Estimate seen = estimator->estimate();
    for (int k = 1; k <= 5; ++k) {
      fly(*estimator, flight, before, {}, 4);
      EXPECT_EQ(estimator->estimate().holds, has_memory || k < 4) << k;
    }
    EXPECT_TRUE(estimator->estimate().health.isApprox(seen.health, 1e-4));
    EXPECT_TRUE(estimator->estimate().health_sigma.isApprox(seen.health_sigma, 1e-4));
    fly(*estimator, flight, before);
    EXPECT_TRUE(estimator->estimate().holds);
  }
}

TEST(SnapshotEstimators, LeastSquaresKnowsLessThanMapAndMapThanManySamples) {
  auto flight = some_engine(4), twin = some_engine(4), third = some_engine(4);
  const auto map = make("map"), wls = make("wls"), rls = make("rls");
  Conditions of_map, of_wls, of_rls;
  for (int k = 0; k < 400; ++k) {
    fly(*map, flight, of_map);
    fly(*wls, twin, of_wls);
    fly(*rls, third, of_rls);
  }
  const auto variance = [](const Estimator& e) { return e.estimate().health_sigma.squaredNorm(); };
  for (Eigen::Index i = 0; i < health; ++i)
    EXPECT_GE(wls->estimate().health_sigma(i), 0.999999 * map->estimate().health_sigma(i)) << i;
  EXPECT_LT(variance(*map), variance(*wls));
  EXPECT_LT(variance(*rls), variance(*map));
  // the formal sigma of least squares lacks what seven sensors do not see of ten parameters of 2 %: three directions
  EXPECT_NEAR(wls->estimate().health_sigma.squaredNorm() - wls->estimate().health_sigma_filter.squaredNorm(),
              3.0 * 0.02 * 0.02, 1e-9);
  EXPECT_TRUE(map->estimate().health_sigma_filter.isApprox(map->estimate().health_sigma, 1e-9));
  EXPECT_TRUE(map->estimate().settled && wls->estimate().settled);
}

TEST(SnapshotEstimators, AShortMemoryExplainsTheReadingsAfterAStepAndALongOneDoesNot) {
  const auto quick = make("rls", 1.0), slow = make("rls", 3600.0);
  auto flight = some_engine(5), twin = some_engine(5);
  Conditions of_quick, of_slow;
  Eigen::VectorXd left_by_quick = Eigen::VectorXd::Zero(sensors), left_by_slow = left_by_quick;
  constexpr int before = 3500, after = 400, judged = 100;
  for (int k = 0; k < before + after; ++k) {
    if (k == before) {
      Eigen::VectorXd stepped = flight.health();
      stepped(2) -= 0.04;
      flight.set_health(stepped);
      twin.set_health(stepped);
    }
    fly(*quick, flight, of_quick);
    fly(*slow, twin, of_slow);
    if (k < before + after - judged) continue;
    left_by_quick += quick->innovation().value / judged;
    left_by_slow += slow->innovation().value / judged;
  }
  const Eigen::VectorXd& noise = test::made_up_design()->model.sensor_noise_sigma;
  EXPECT_LT(left_by_quick.cwiseQuotient(noise).norm(), 0.5);  // e^-6 of the step, and the noise of 100 samples
  EXPECT_GT(left_by_slow.cwiseQuotient(noise).norm(), 2.0);
}

}  // namespace
