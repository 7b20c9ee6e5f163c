// SPDX-License-Identifier: Apache-2.0
// The time-varying full-order filter against what is known in closed form: MAP on averages, the information form, the
// Bayes limit; and its covariance against its own errors over a fleet.

#include "monitor/estimation/time_varying_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/scaling.h"
#include "engine_sim/linear_model/stationary_covariance.h"
#include "monitor/estimation/steady_gain.h"
#include "tests/unit/monitor/estimation/allocation_counter.h"
#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/full_order/limit_after.h"
#include "tuner_design/theory/bayes_limit.h"
#include "tuner_design/theory/map_estimator.h"

namespace ehm::estimation {
namespace {

/// Made-up engine in scaled units, with and without process noise.
linear_model::LinearModel scaled_engine(bool process_noise) {
  const linear_model::LinearModel model = test::made_up_model(4, 6);
  linear_model::LinearModel result = linear_model::scaled(model, linear_model::scaling_of(model));
  if (!process_noise) result.process_noise.setZero();
  return result;
}

struct Fleet {
  explicit Fleet(const linear_model::LinearModel& model)
      : steady(steady_gain(model)),
        Ph(model.health_sigma.cwiseAbs2().asDiagonal()),
        R(model.sensor_noise_sigma.cwiseAbs2().asDiagonal()) {}
  SteadyGain steady;
  Eigen::MatrixXd Ph, R;
};

/// Health covariance of full MAP on the average of `samples` samples.
Eigen::MatrixXd map_on_average(const Fleet& fleet, int samples) {
  const Eigen::MatrixXd R = fleet.R / samples;
  const Eigen::MatrixXd E = tuner_design::full_map_gain(fleet.steady.H, fleet.Ph, R);
  return tuner_design::snapshot_error_covariance(E, fleet.steady.H, fleet.Ph, R);
}

const SensorMask all_sensors = SensorMask{}.set();
const ActuatorVector no_actuators = ActuatorVector::Zero(1);

TEST(TimeVaryingFilter, OneSampleOfASettledEngineIsFullMap) {
  const linear_model::LinearModel model = scaled_engine(false);
  const Fleet fleet(model);
  test::Random random(1);
  const Eigen::VectorXd y = random.normal_vector(4);
  TimeVaryingFilter filter(full_order_model(model));
  filter.innovation(y, no_actuators);
  filter.update(all_sensors);
  const Eigen::VectorXd map = tuner_design::full_map_gain(fleet.steady.H, fleet.Ph, fleet.R) * y;
  EXPECT_LT((filter.health() - map).norm(), 1e-12 * map.norm());
  EXPECT_LT((filter.auxiliary() - fleet.steady.Hz * map).norm(), 1e-12 * map.norm());
  EXPECT_TRUE(filter.covariance().bottomRightCorner(6, 6).isApprox(map_on_average(fleet, 1), 1e-12));
  EXPECT_TRUE(filter.auxiliary_variance().isApprox(
      (fleet.steady.Hz * map_on_average(fleet, 1) * fleet.steady.Hz.transpose()).diagonal(), 1e-12));
}

TEST(TimeVaryingFilter, OneSampleOfAMovingEngineIsFullMapWithItsMotionAsNoise) {
  // The sensors then read H h + C dx + v with the stationary cov(dx): full MAP with R + C cov(dx) C^T.
  const linear_model::LinearModel model = scaled_engine(true);
  const Fleet fleet(model);
  const Eigen::MatrixXd motion = linear_model::stationary_covariance(model.A, model.process_noise);
  EXPECT_LT((model.A * motion * model.A.transpose() + model.process_noise - motion).norm(), 1e-12 * motion.norm());
  const Eigen::MatrixXd R = fleet.R + model.C * motion * model.C.transpose();
  const Eigen::MatrixXd E = tuner_design::full_map_gain(fleet.steady.H, fleet.Ph, R);
  TimeVaryingFilter filter(full_order_model(model));
  filter.update(all_sensors);
  EXPECT_TRUE(filter.covariance().bottomRightCorner(6, 6).isApprox(
      tuner_design::snapshot_error_covariance(E, fleet.steady.H, fleet.Ph, R), 1e-9));
}

TEST(TimeVaryingFilter, ManySamplesAreMapOnTheirAverageAndTendToTheBayesLimit) {
  const linear_model::LinearModel model = scaled_engine(false);
  const Fleet fleet(model);
  for (const int samples : {1, 2, 10, 1000}) {
    SCOPED_TRACE(samples);
    const Eigen::MatrixXd map = map_on_average(fleet, samples);
    const design::ErrorByChannel limit = tuner_design::limit_after(model, samples);
    EXPECT_TRUE(limit.health.isApprox(map.diagonal(), 1e-9));
    EXPECT_TRUE(limit.auxiliary.isApprox((fleet.steady.Hz * map * fleet.steady.Hz.transpose()).diagonal(), 1e-9));
  }
  const Eigen::MatrixXd U = tuner_design::bayes_limit_factor(fleet.steady.H, fleet.Ph);
  const design::ErrorByChannel late = tuner_design::limit_after(model, 100000);
  EXPECT_GT(late.health.sum(), U.squaredNorm());
  EXPECT_NEAR(late.health.sum() / U.squaredNorm(), 1.0, 1e-4);
  EXPECT_NEAR(late.auxiliary.sum() / (fleet.steady.Hz * U).squaredNorm(), 1.0, 1e-3);
}

TEST(TimeVaryingFilter, TheWindowIsTheMeanOfItsSamples) {
  const linear_model::LinearModel model = scaled_engine(true);
  const design::ErrorByChannel nine = tuner_design::limit_after(model, 9), ten = tuner_design::limit_after(model, 10);
  const design::ErrorByChannel mean = tuner_design::limit_after(model, 10, 2);
  EXPECT_TRUE(mean.health.isApprox(0.5 * (nine.health + ten.health), 1e-14));
  EXPECT_TRUE(mean.auxiliary.isApprox(0.5 * (nine.auxiliary + ten.auxiliary), 1e-14));
  EXPECT_THROW(tuner_design::limit_after(model, 10, 11), std::invalid_argument);
  EXPECT_THROW(tuner_design::limit_after(model, 10, 0), std::invalid_argument);
}

/// Every third sample lacks sensor 1, every fifth all but sensor 2.
SensorMask present_at(int k) {
  if (k % 5 == 0) return SensorMask(0b0100);
  return k % 3 == 0 ? SensorMask(0b1101) : SensorMask(0b1111);
}

TEST(TimeVaryingFilter, AVaryingSensorSetAddsUpItsInformation) {
  // Without process noise: Phh^-1 = Ph^-1 + sum over samples and fused sensors of H_i^T H_i / r_i.
  const linear_model::LinearModel model = scaled_engine(false);
  const Fleet fleet(model);
  TimeVaryingFilter filter(full_order_model(model));
  Eigen::MatrixXd information = fleet.Ph.inverse();
  SensorVector y = SensorVector::Zero(4);
  for (int k = 0; k < 100; ++k) {
    if (k > 0) filter.predict(no_actuators);
    for (int i = 0; i < 4; ++i) {
      const bool present = present_at(k)[as_size(i)];
      y(i) = present ? 0.1 * i : std::numeric_limits<double>::quiet_NaN();
      if (present) information += fleet.steady.H.row(i).transpose() * fleet.steady.H.row(i) / fleet.R(i, i);
    }
    filter.innovation(y, no_actuators);
    filter.update(present_at(k));
  }
  const Eigen::MatrixXd expected = information.llt().solve(Eigen::MatrixXd::Identity(6, 6));
  EXPECT_TRUE(filter.covariance().bottomRightCorner(6, 6).isApprox(expected, 1e-9));
  EXPECT_TRUE(filter.health().allFinite()) << "a sensor that is not fused may be NaN";
}

TEST(TimeVaryingFilter, NothingFusedMovesNothingAndKeepsTheSettledEngine) {
  const linear_model::LinearModel model = scaled_engine(false);
  TimeVaryingFilter filter(full_order_model(model));
  const FullOrderCovariance before = filter.covariance();
  for (int k = 0; k < 10; ++k) {
    filter.predict(no_actuators);
    filter.innovation(SensorVector::Ones(4), no_actuators);
    filter.update(SensorMask{});
  }
  EXPECT_EQ(filter.health().norm(), 0.0);
  EXPECT_TRUE(filter.covariance().isApprox(before, 1e-12)) << "a settled engine stays settled";
}

TEST(TimeVaryingFilter, CovarianceStaysSymmetricAndDefiniteForHalfAnHour) {
  const linear_model::LinearModel model = scaled_engine(true);
  TimeVaryingFilter filter(full_order_model(model));
  for (int k = 0; k < 120000; ++k) {
    filter.predict(no_actuators);
    filter.update(present_at(k));
  }
  const Eigen::MatrixXd P = filter.covariance();
  EXPECT_EQ((P - P.transpose()).norm(), 0.0);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(P).eigenvalues().minCoeff(), 0.0);
}

/// Errors of health and outputs, and squared normalised innovations, of one flight with moving actuators.
struct Flight {
  Eigen::VectorXd health, auxiliary, innovation;
};

Flight fly(const linear_model::LinearModel& model, const SteadyGain& steady, TimeVaryingFilter& filter,
           test::Random& random) {
  constexpr int samples = 40;
  const Eigen::VectorXd h = model.health_sigma.cwiseProduct(random.normal_vector(6));
  const Eigen::VectorXd w_sigma = model.process_noise.diagonal().cwiseSqrt();
  const Eigen::MatrixXd motion =
      linear_model::covariance_root(linear_model::stationary_covariance(model.A, model.process_noise));
  Eigen::VectorXd x = steady.X * h + motion * random.normal_vector(2), z;
  ActuatorVector u = ActuatorVector::Zero(1), previous = u;
  filter.reset();
  for (int k = 0; k < samples; ++k) {
    u(0) = 0.02 * std::sin(0.3 * k);
    if (k > 0) {
      x = (model.A * x + model.B * previous + model.L * h + w_sigma.cwiseProduct(random.normal_vector(2))).eval();
      filter.predict(previous);
    }
    const Eigen::VectorXd v = model.sensor_noise_sigma.cwiseProduct(random.normal_vector(4));
    filter.innovation(model.C * x + model.D * u + model.M * h + v, u);
    filter.update(present_at(k));
    z = model.F * x + model.G * u + model.N * h;
    previous = u;
  }
  return {filter.health() - h, filter.auxiliary() - z,
          filter.innovation().cwiseAbs2().cwiseQuotient(filter.innovation_variance())};
}

TEST(TimeVaryingFilter, CovarianceIsThatOfItsErrorsOverTheFleet) {
  // e is normal, so that the mean of e^2 over N engines scatters with sigma^2 sqrt(2/N); 3.5 of these for 12 channels.
  constexpr int engines = 3000;
  linear_model::LinearModel model = scaled_engine(true);
  model.process_noise.diagonal().setConstant(0.04);  // large enough to matter beside 0.5 % of sensor noise
  const SteadyGain steady = steady_gain(model);
  TimeVaryingFilter filter(full_order_model(model));
  test::Random random(2010);
  Flight sum{Eigen::VectorXd::Zero(6), Eigen::VectorXd::Zero(2), Eigen::VectorXd::Zero(4)};
  for (int i = 0; i < engines; ++i) {
    const Flight flight = fly(model, steady, filter, random);
    sum.health += flight.health.cwiseAbs2();
    sum.auxiliary += flight.auxiliary.cwiseAbs2();
    sum.innovation += flight.innovation;
  }
  const double tolerance = 3.5 * std::sqrt(2.0 / engines);
  EXPECT_TRUE(((sum.health.cwiseQuotient(filter.health_variance()) / engines).array() - 1.0).abs().maxCoeff() <
              tolerance);
  EXPECT_TRUE(((sum.auxiliary.cwiseQuotient(filter.auxiliary_variance()) / engines).array() - 1.0).abs().maxCoeff() <
              tolerance);
  EXPECT_TRUE(((sum.innovation / engines).array() - 1.0).abs().maxCoeff() < tolerance);
}

TEST(TimeVaryingFilter, AllocatesNothing) {
  TimeVaryingFilter filter(full_order_model(scaled_engine(true)));
  const SensorVector y = SensorVector::Ones(4);
  const long before = test::allocation_count();
  for (int k = 0; k < 10; ++k) {
    filter.predict(no_actuators);
    filter.innovation(y, no_actuators);
    filter.update(present_at(k));
    if (filter.health_variance().size() != 6 || filter.auxiliary_variance().size() != 2) break;
  }
  filter.reset();
  EXPECT_EQ(test::allocation_count(), before);
}

TEST(FullOrderModelTest, RefusesWhatItCannotHold) {
  linear_model::LinearModel model = scaled_engine(true);
  model.discrete = false;
  EXPECT_THROW(full_order_model(model), std::invalid_argument);
  EXPECT_THROW(full_order_model(test::made_up_model(17, 6)), std::invalid_argument);
}

}  // namespace
}  // namespace ehm::estimation
