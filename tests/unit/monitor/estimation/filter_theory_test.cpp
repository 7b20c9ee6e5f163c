// SPDX-License-Identifier: Apache-2.0
// The filter on the linear truth against the theory of its error: constant health drawn from the fleet, sensor noise,
// process noise, moving actuators. Squared errors must agree with the published variances within 3 standard errors.

#include <gtest/gtest.h>

#include <cmath>

#include "deploy/runtime/numbers/index.h"
#include "monitor/design/make_filter.h"
#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/design/design_tuner.h"

namespace ehm::estimation {
namespace {

constexpr int engines = 1500;
constexpr int samples = 1500;  // 22.5 s, more than ten of the slowest time constants (asserted)

struct Errors {
  Eigen::MatrixXd health, auxiliary;  ///< one column an engine
};

/// Final errors of the filter over the fleet with one sensor set.
Errors fly_fleet(const design::Design& design, SensorSet set, test::Random& random) {
  const linear_model::LinearModel& model = design.model;
  TunerFilter filter = design::make_filter(design);
  Errors errors{Eigen::MatrixXd(model.L.cols(), engines), Eigen::MatrixXd(model.F.rows(), engines)};
  Eigen::VectorXd z_trim(model.F.rows());
  for (Eigen::Index i = 0; i < z_trim.size(); ++i) z_trim(i) = model.auxiliary[as_size(i)].trim;
  for (int engine = 0; engine < engines; ++engine) {
    const Eigen::VectorXd h = model.health_sigma.cwiseProduct(random.normal_vector(model.L.cols()));
    Eigen::VectorXd x = Eigen::VectorXd::Zero(model.A.rows());
    const Eigen::VectorXd w_sigma = model.process_noise.diagonal().cwiseSqrt();
    ActuatorVector u = ActuatorVector::Zero(1), previous = u;
    filter.reset();
    filter.switch_sensor_set(set);
    for (int k = 0; k < samples; ++k) {
      u(0) = 0.02 * std::sin(0.05 * k + engine);
      const Eigen::VectorXd w = w_sigma.cwiseProduct(random.normal_vector(w_sigma.size()));
      x = (model.A * x + model.B * previous + model.L * h + w).eval();
      const Eigen::VectorXd v = model.sensor_noise_sigma.cwiseProduct(random.normal_vector(model.C.rows()));
      filter.predict(previous);
      filter.innovation(model.C * x + model.D * u + model.M * h + v, u);
      filter.update(SensorMask(0xFFFF));
      previous = u;
    }
    errors.health.col(engine) = filter.health() - h;
    errors.auxiliary.col(engine) = filter.auxiliary() - z_trim - (model.F * x + model.G * u + model.N * h);
  }
  return errors;
}

/// Mean of e and of e^2 against 0 and sigma^2; e is normal, so that var(e^2) = 2 sigma^4.
void expect_agreement(const Eigen::MatrixXd& errors, const Eigen::VectorXd& sigma, const char* what) {
  const double root = std::sqrt(static_cast<double>(engines));
  for (Eigen::Index i = 0; i < sigma.size(); ++i) {
    SCOPED_TRACE(std::string(what) + " " + std::to_string(i));
    EXPECT_LT(std::abs(errors.row(i).mean()), 3.0 * sigma(i) / root);
    const double ratio = errors.row(i).squaredNorm() / engines / (sigma(i) * sigma(i));
    EXPECT_NEAR(ratio, 1.0, 3.0 * std::sqrt(2.0) / root);
  }
}

class FilterTheory : public ::testing::Test {
 protected:
  /// An engine that moves so much that a theory without process noise fails.
  static linear_model::LinearModel restless() {
    linear_model::LinearModel model = test::made_up_model();
    model.process_noise *= 4.0;
    return model;
  }
  const design::Design design = tuner_design::design_tuner(restless(), {});
  test::Random random{77};
};

TEST_F(FilterTheory, AllSensors) {
  ASSERT_LT(10.0 * design.full.slowest_time_constant_s, samples * design.model.sample_time_s);
  const TunerFilter filter = design::make_filter(design);
  const Errors errors = fly_fleet(design, SensorSet::full(), random);
  expect_agreement(errors.health, filter.health_sigma_total(), "health");
  expect_agreement(errors.auxiliary, filter.auxiliary_sigma_total(), "auxiliary");
  // The filter's own sigma is no substitute: it does not know what it does not see.
  const double own = filter.health_sigma_filter().squaredNorm();
  EXPECT_LT(own, 0.5 * errors.health.squaredNorm() / engines);
}

TEST_F(FilterTheory, OneSensorMissing) {
  ASSERT_LT(10.0 * design.missing[3]->slowest_time_constant_s, samples * design.model.sample_time_s);
  TunerFilter filter = design::make_filter(design);
  ASSERT_TRUE(filter.switch_sensor_set(SensorSet::without(3)));
  const Errors errors = fly_fleet(design, SensorSet::without(3), random);
  expect_agreement(errors.health, filter.health_sigma_total(), "health");
  expect_agreement(errors.auxiliary, filter.auxiliary_sigma_total(), "auxiliary");
}

}  // namespace
}  // namespace ehm::estimation
