// SPDX-License-Identifier: Apache-2.0
// The filter on a schedule against an engine that is the schedule, over a climb; what it does without a sensor, outside
// the grid, and that it allocates nothing.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "deploy/runtime/numbers/noise_source.h"
#include "engine_sim/model/thermo/ram.h"
#include "monitor/schedule/scheduled_estimator.h"
#include "tests/unit/monitor/estimation/allocation_counter.h"
#include "tests/unit/monitor/schedule/small_schedule.h"

namespace {

using namespace ehm;
using namespace ehm::schedule;

constexpr double step_s = 0.1;

std::shared_ptr<ScheduledModel> small_model() {
  auto model = std::make_shared<ScheduledModel>(test::small_schedule(), ScheduledOptions{.sample_time_s = step_s});
  model->state_scale = estimation::StateVector::Constant(1, 20.0);
  model->sensor_scale = Eigen::Vector2d(20.0, 6.0);
  model->noise = Eigen::Vector2d(0.5, 0.3);
  model->trim = Eigen::Vector2d(2000.0, 600.0);
  model->lag_s = Eigen::Vector2d(0.0, 0.0);
  model->health_scale = Eigen::Vector2d(0.01, 0.01);
  model->health_sigma = Eigen::Vector2d(2.0, 2.0);
  model->sensor_of_state = {0};
  return model;
}

/// The table as an engine: its state by fine steps, its readings with noise.
class TableEngine {
 public:
  explicit TableEngine(std::uint64_t seed, Eigen::Vector2d percent)
      : lookup_(test::small_schedule()), h_(percent), random_(seed) {}

  estimation::Conditions at(double time_s) const {
    const double share = std::min(1.0, time_s / 600.0);
    estimation::Conditions now;
    now.flight = {8000.0 * share, 0.2 + 0.5 * share, 0.0};
    PointModel m;
    const auto ram = engine_sim::ram_ratios(now.flight.altitude_m, now.flight.mach, 0.0);
    lookup_.at({1400.0 + 1200.0 * share, now.flight.mach, ram.theta, ram.delta, 0.0}, m);
    now.actuators = m.u0;
    return now;
  }
  estimation::SensorVector read(double time_s) {
    const estimation::Conditions now = at(time_s);
    const auto ram = engine_sim::ram_ratios(now.flight.altitude_m, now.flight.mach, 0.0);
    PointModel m;
    if (x_ == 0.0) x_ = 1400.0;
    for (int k = 0; k < 10; ++k) {
      lookup_.at({x_ / std::sqrt(ram.theta), now.flight.mach, ram.theta, ram.delta, 0.0}, m);
      x_ += 0.1 * step_s * (m.A(0, 0) * (x_ - m.x0(0)) + m.B(0, 0) * (now.actuators(0) - m.u0(0)) + (m.L * h_).value());
    }
    lookup_.at({x_ / std::sqrt(ram.theta), now.flight.mach, ram.theta, ram.delta, 0.0}, m);
    estimation::SensorVector y =
        m.y0 + m.C * (estimation::StateVector::Constant(1, x_) - m.x0) + m.D * (now.actuators - m.u0) + m.M * h_;
    y(0) += 0.5 * y(0) / 2000.0 * random_.normal();
    y(1) += 0.3 * y(1) / 600.0 * random_.normal();
    return y;
  }

 private:
  PointLookup lookup_;
  Eigen::Vector2d h_;
  double x_ = 0.0;
  NoiseSource random_;
};

void fly(ScheduledEstimator& estimator, TableEngine& engine, double from_s, double to_s,
         estimation::SensorMask fused = 0b11u) {
  estimator.use(fused);
  for (double t = from_s; t < to_s; t += step_s) {
    const estimation::Conditions now = engine.at(t);
    estimator.predict(now, 1);
    estimator.innovate(engine.read(t), now);
    estimator.update(fused, 1);
  }
}

TEST(ScheduledEstimator, LearnsHealthOverAClimbAndKnowsHowWell) {
  int covered = 0, judged = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    NoiseSource random(100 + seed);
    const Eigen::Vector2d h(2.0 * random.normal(), 2.0 * random.normal());
    ScheduledEstimator estimator(small_model());
    TableEngine engine(seed, h);
    fly(estimator, engine, 0.0, 900.0);
    ASSERT_TRUE(estimator.estimate().holds);
    for (Eigen::Index i = 0; i < 2; ++i) {
      ++judged;
      covered += std::abs(estimator.estimate().health(i) - 0.01 * h(i)) < 1.96 * estimator.estimate().health_sigma(i);
      EXPECT_LT(std::abs(100.0 * estimator.estimate().health(i) - h(i)), 0.5) << seed;
    }
  }
  EXPECT_GE(covered, judged * 85 / 100);
}

TEST(ScheduledEstimator, FindsItsPlaceByTheFuelFlowWhereNoSpeedIsMeasured) {
  ScheduledEstimator estimator(small_model());
  TableEngine engine(3, {1.0, -1.0});
  fly(estimator, engine, 0.0, 100.0, 0b10u);
  EXPECT_TRUE(estimator.estimate().holds);
  EXPECT_EQ(estimator.estimate().sensors.to_ulong(), 0b10u);
}

TEST(ScheduledEstimator, OutsideTheGridItDoesNotHold) {
  ScheduledEstimator estimator(small_model());
  estimation::Conditions now = TableEngine(1, {0.0, 0.0}).at(0.0);
  EXPECT_LE(estimator.distance(now), 1.0);
  now.flight.mach = 1.2;
  EXPECT_GT(estimator.distance(now), 1.0);
  now.flight.altitude_m = 50'000.0;
  EXPECT_TRUE(std::isinf(estimator.distance(now)));
}

TEST(ScheduledEstimator, IsAsNewAfterAReset) {
  ScheduledEstimator estimator(small_model()), fresh(small_model());
  TableEngine first(4, {1.0, 2.0}), second(5, {-1.0, 0.5}), same(5, {-1.0, 0.5});
  fly(estimator, first, 0.0, 50.0);
  estimator.reset();
  fly(estimator, second, 0.0, 50.0);
  fly(fresh, same, 0.0, 50.0);
  EXPECT_EQ(estimator.estimate().health, fresh.estimate().health);
  EXPECT_EQ(estimator.estimate().auxiliary_sigma, fresh.estimate().auxiliary_sigma);
}

TEST(ScheduledEstimator, AllocatesNothing) {
  ScheduledEstimator estimator(small_model());
  TableEngine engine(6, {1.0, 2.0});
  std::vector<std::pair<estimation::SensorVector, estimation::Conditions>> samples;
  for (double t = 0.0; t < 100.0; t += step_s) samples.emplace_back(engine.read(t), engine.at(t));
  const long before = test::allocation_count();
  for (const auto& [y, now] : samples) {
    estimator.use(0b11u);
    estimator.predict(now, 1);
    estimator.innovate(y, now);
    estimator.update(0b11u, 1);
    estimator.widen(1.5);
  }
  estimator.reset();
  EXPECT_EQ(test::allocation_count(), before);
}

}  // namespace
