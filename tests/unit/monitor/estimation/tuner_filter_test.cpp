// SPDX-License-Identifier: Apache-2.0
// TunerFilter: what it does with sensors that are not fused, with switched sensor sets, with inputs, and no allocation.

#include "monitor/estimation/tuner_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "deploy/runtime/numbers/decompositions.h"
#include "monitor/design/make_filter.h"
#include "monitor/estimation/steady_gain.h"
#include "tests/unit/monitor/estimation/allocation_counter.h"
#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/design/design_tuner.h"

namespace ehm::estimation {
namespace {

const SensorMask all{0xFFFF};

/// Filter of a made-up engine, 4 sensors and 6 health parameters.
struct Bench {
  design::Design design = tuner_design::design_tuner(test::made_up_model(), {});
  TunerFilter filter = design::make_filter(design);
  Eigen::MatrixXd H = steady_gain(design.model).H;
  Eigen::MatrixXd Hz = steady_gain(design.model).Hz;
  ActuatorVector no_input = ActuatorVector::Zero(1);

  void step(const SensorVector& dy, SensorMask fused = all) {
    filter.predict(no_input);
    filter.innovation(dy, no_input);
    filter.update(fused);
  }
};

Eigen::VectorXd some_health() {
  Eigen::VectorXd h(6);
  h << -0.02, 0.01, -0.005, 0.015, -0.01, 0.02;
  return h;
}

TEST(TunerFilter, StartsAtTrimWithThePublishedSigmas) {
  Bench bench;
  EXPECT_EQ(bench.filter.health(), HealthVector::Zero(6));
  EXPECT_DOUBLE_EQ(bench.filter.auxiliary()(0), 2350.0);
  EXPECT_DOUBLE_EQ(bench.filter.auxiliary()(1), 10700.0);
  EXPECT_EQ(bench.filter.tuners().size(), 4);
  // Health sigma in fractions, temperature in degR, thrust in lbf: the units of the model's channels.
  const design::SubsetDesign& full = bench.design.full;
  EXPECT_NEAR(bench.filter.health_sigma_total()(2), 0.01 * std::sqrt(full.health_total_covariance(2, 2)), 1e-15);
  EXPECT_NEAR(bench.filter.auxiliary_sigma_total()(0), 1.8 * std::sqrt(full.auxiliary_total_covariance(0, 0)), 1e-12);
  EXPECT_NEAR(bench.filter.auxiliary_sigma_total()(1), 107.0 * std::sqrt(full.auxiliary_total_covariance(1, 1)), 1e-9);
  EXPECT_TRUE((bench.filter.health_sigma_filter().array() < bench.filter.health_sigma_total().array()).all());
}

TEST(TunerFilter, ConvergesToTheObliqueProjectionAndReproducesTheSensors) {
  // hhat -> W (H W)^-1 H h, and so H hhat = H h.
  Bench bench;
  const Eigen::VectorXd h = some_health();
  for (int k = 0; k < 20000; ++k) bench.step(bench.H * h);
  const Eigen::MatrixXd& W = bench.design.full.W;  // equal health scales cancel
  const Eigen::VectorXd expected = W * (bench.H * W).partialPivLu().solve(bench.H * h);
  EXPECT_LT((bench.filter.health() - expected).norm() / expected.norm(), 1e-9);
  EXPECT_LT((bench.H * bench.filter.health() - bench.H * h).norm() / (bench.H * h).norm(), 1e-9);
  EXPECT_LT(bench.filter.innovation().norm(), 1e-9 * (bench.H * h).norm());
  const Eigen::Vector2d z(2350.0, 10700.0);
  EXPECT_LT((bench.filter.auxiliary() - z - bench.Hz * expected).norm(), 1e-6);
}

TEST(TunerFilter, KnownInputsDoNotDisturb) {
  // x+ = A x + B u, y = C x + D u, z = F x + G u with h = 0: the filter knows u, and so it follows without error.
  Bench bench;
  const linear_model::LinearModel& model = bench.design.model;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(2);
  ActuatorVector previous = ActuatorVector::Zero(1);
  for (int k = 0; k < 200; ++k) {
    ActuatorVector u(1);
    u << 0.05 * std::sin(0.1 * k);
    x = (model.A * x + model.B * previous).eval();
    bench.filter.predict(previous);
    bench.filter.innovation(model.C * x + model.D * u, u);
    bench.filter.update(all);
    EXPECT_LT(bench.filter.innovation().norm(), 1e-9);
    EXPECT_LT(bench.filter.health().norm(), 1e-12);
    const Eigen::Vector2d z = Eigen::Vector2d(2350.0, 10700.0) + model.F * x + model.G * u;
    EXPECT_LT((bench.filter.auxiliary() - z).norm(), 1e-7);
    previous = u;
  }
}

TEST(TunerFilter, AnUnfusedSensorIsBridgedEvenIfItIsNan) {
  Bench a, b;
  const Eigen::VectorXd y = a.H * some_health();
  SensorVector broken = y;
  broken(2) = std::numeric_limits<double>::quiet_NaN();
  SensorVector wild = y;
  wild(2) = 1e9;
  const SensorMask without_2 = ~SensorMask().set(2);
  for (int k = 0; k < 50; ++k) {
    a.step(broken, without_2);
    b.step(wild, without_2);
  }
  EXPECT_TRUE(a.filter.health().allFinite());
  EXPECT_EQ(a.filter.health(), b.filter.health());
  EXPECT_TRUE(std::isnan(a.filter.innovation()(2))) << "published as measured";
  EXPECT_TRUE(std::isfinite(a.filter.innovation()(1)));
}

TEST(TunerFilter, WithNothingFusedItPredicts) {
  Bench bench;
  for (int k = 0; k < 5000; ++k) bench.step(bench.H * some_health());
  const HealthVector before = bench.filter.health();
  for (int k = 0; k < 100; ++k) bench.step(SensorVector::Zero(4), SensorMask());
  EXPECT_LT((bench.filter.health() - before).norm(), 1e-12);
}

TEST(TunerFilter, SwitchingKeepsWhatTheRemainingSensorsSee) {
  Bench bench;
  for (int k = 0; k < 300; ++k) bench.step(bench.H * some_health());  // not yet settled: the state moves, too
  const HealthVector before = bench.filter.health();
  TunerFilter stays = bench.filter;
  ASSERT_TRUE(bench.filter.switch_sensor_set(SensorSet::without(2)));
  EXPECT_EQ(bench.filter.sensor_set(), SensorSet::without(2));
  EXPECT_EQ(bench.filter.sensors(), SensorMask("1011"));
  EXPECT_EQ(bench.filter.tuners().size(), 3);
  EXPECT_GT((bench.filter.health() - before).norm(), 1e-6) << "fewer tuners: health itself moves";
  for (const int i : {0, 1, 3}) {
    EXPECT_NEAR(bench.H.row(i).dot(bench.filter.health()), bench.H.row(i).dot(before), 1e-9 * bench.H.row(i).norm());
  }
  // Nor do the predictions of these sensors change, now and later.
  for (int k = 0; k < 50; ++k) {
    for (TunerFilter* filter : {&bench.filter, &stays}) {
      filter->predict(bench.no_input);
      filter->innovation(SensorVector::Zero(4), bench.no_input);
      filter->update(SensorMask());
    }
    for (const int i : {0, 1, 3}) EXPECT_NEAR(bench.filter.innovation()(i), stays.innovation()(i), 1e-7) << k;
  }
}

TEST(TunerFilter, SwitchingBetweenTwoMissingSensorsIsExact) {
  Bench bench;
  for (int k = 0; k < 300; ++k) bench.step(bench.H * some_health());
  ASSERT_TRUE(bench.filter.switch_sensor_set(SensorSet::without(2)));
  const HealthVector before = bench.filter.health();
  ASSERT_TRUE(bench.filter.switch_sensor_set(SensorSet::without(0)));
  for (const int i : {1, 2, 3}) {
    EXPECT_NEAR(bench.H.row(i).dot(bench.filter.health()), bench.H.row(i).dot(before), 1e-9 * bench.H.row(i).norm());
  }
  ASSERT_TRUE(bench.filter.switch_sensor_set(SensorSet::full()));
  EXPECT_TRUE(bench.filter.sensor_set().is_full());
}

TEST(TunerFilter, AMissingSensorIsIgnoredAndItsVarianceCountsTheBias) {
  Bench bench;
  const double used = bench.filter.innovation_variance()(2);
  ASSERT_TRUE(bench.filter.switch_sensor_set(SensorSet::without(2)));
  EXPECT_GT(bench.filter.innovation_variance()(2), used);
  SensorVector wild = SensorVector::Zero(4);
  wild(2) = 1e9;
  bench.step(wild);
  EXPECT_EQ(bench.filter.health(), HealthVector::Zero(6));
}

TEST(TunerFilter, ASetWithoutADesignChangesNothing) {
  Bench bench;
  bench.step(bench.H * some_health());
  const HealthVector before = bench.filter.health();
  EXPECT_FALSE(bench.filter.available(SensorSet::without(4)));
  EXPECT_FALSE(bench.filter.switch_sensor_set(SensorSet::without(4)));
  EXPECT_EQ(bench.filter.health(), before);
  EXPECT_TRUE(bench.filter.sensor_set().is_full());
}

TEST(TunerFilter, ResetForgets) {
  Bench bench;
  for (int k = 0; k < 100; ++k) bench.step(bench.H * some_health());
  bench.filter.switch_sensor_set(SensorSet::without(1));
  bench.filter.reset();
  EXPECT_EQ(bench.filter.health(), HealthVector::Zero(6));
  EXPECT_TRUE(bench.filter.sensor_set().is_full());
  EXPECT_DOUBLE_EQ(bench.filter.auxiliary()(0), 2350.0);
  Bench fresh;
  fresh.step(fresh.H * some_health());
  bench.step(bench.H * some_health());
  EXPECT_EQ(bench.filter.health(), fresh.filter.health());
}

TEST(TunerFilter, HealthAtTrimIsAdded) {
  linear_model::LinearModel model = test::made_up_model();
  model.health[3].trim = -0.015;
  const TunerFilter filter = design::make_filter(tuner_design::design_tuner(model, {}));
  EXPECT_DOUBLE_EQ(filter.health()(3), -0.015);
}

TEST(TunerFilter, NothingAllocatesAfterConstruction) {
  Bench bench;
  const SensorVector y = bench.H * some_health();
  const long before = test::allocation_count();
  for (int k = 0; k < 100; ++k) {
    bench.step(y);
    bench.filter.switch_sensor_set(SensorSet::without(k % 4));
    bench.step(y, SensorMask("0101"));
    bench.filter.switch_sensor_set(SensorSet::full());
  }
  bench.filter.reset();
  EXPECT_EQ(test::allocation_count() - before, 0);
}

TEST(TunerFilter, TheCounterCountsWhatEigenAndNewAllocate) {
  const long before = test::allocation_count();
  const Eigen::VectorXd dynamic = Eigen::VectorXd::Ones(30);
  EXPECT_EQ(test::allocation_count() - before, 1) << dynamic.sum();
  const auto object = std::make_unique<double>(1.0);
  EXPECT_EQ(test::allocation_count() - before, 2) << *object;
}

TEST(TunerFilter, MatricesThatDoNotFitAreNamed) {
  TunerFilterModel model = design::make_filter(tuner_design::design_tuner(test::made_up_model(), {})).model();
  model.full.K.resize(6, 3);
  try {
    TunerFilter filter(model);
    FAIL() << "a gain for three sensors was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "tuner filter: full set: K is 6 x 3; expected 6 x 4");
  }
}

TEST(TunerFilter, RefusesTunersThatMoveByThemselves) {
  TunerFilterModel model = Bench().filter.model();
  model.full.A(3, 3) = 0.99;
  try {
    TunerFilter filter(model);
    FAIL() << "a decaying tuner was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "tuner filter: full set: the last 4 rows of A and B move the tuners; expected [0, I] and 0, at least "
                 "one row");
  }
}

TEST(TunerFilter, RefusesHealthThatIsReadFromStates) {
  TunerFilterModel model = Bench().filter.model();
  model.missing[1]->health_output(0, 1) = 1e-3;
  try {
    TunerFilter filter(model);
    FAIL() << "health read from a state was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "tuner filter: without sensor 1: health_output has states in it; expected [0, Rh]");
  }
}

}  // namespace
}  // namespace ehm::estimation
