// SPDX-License-Identifier: Apache-2.0
// The full-order Gauss-Markov filter: the one that flies against its theory, against the plain recursion, and against
// the Bayes limit.

#include "monitor/estimation/gauss_markov_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine_sim/linear_model/discretise.h"
#include "engine_sim/linear_model/scaling.h"
#include "tests/unit/monitor/estimation/allocation_counter.h"
#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/design/design_tuner.h"
#include "tuner_design/full_order/gauss_markov.h"

namespace ehm::estimation {
namespace {

class GaussMarkov : public ::testing::Test {
 protected:
  static design::Design closed_form() {
    design::DesignOptions options;
    options.tuning = design::Tuning::closed_form;
    return tuner_design::design_tuner(test::made_up_model(4, 6), options);
  }
  const design::Design tuners = closed_form();
  const linear_model::LinearModel model = linear_model::scaled(tuners.model, tuners.scaling);
  const SteadyGain steady = steady_gain(model);
  const double rho = tuner_design::gauss_markov_rho(model, tuners.options.qh_percent2);
  const design::SubsetDesign theory = tuner_design::gauss_markov_design(model, steady, rho);
  const GaussMarkovFilter filter{full_order_model(model), tuner_design::gauss_markov_gain(theory, rho)};
  test::Random random{7};
};

TEST_F(GaussMarkov, RhoMatchesTheTunersDriveAndSpeed) {
  // (1 - rho^2) (2 %)^2 = 1e-3 percent^2
  EXPECT_NEAR((1.0 - rho * rho) * 4.0, 1e-3, 1e-12);
  EXPECT_NEAR(theory.slowest_time_constant_s / tuners.full.slowest_time_constant_s, 1.0, 0.02);
  EXPECT_THROW(tuner_design::gauss_markov_rho(model, 4.0), std::invalid_argument);
  EXPECT_THROW(tuner_design::gauss_markov_rho(model, 0.0), std::invalid_argument);
  EXPECT_THROW(tuner_design::gauss_markov_design(model, steady, 1.0), std::invalid_argument);
}

TEST_F(GaussMarkov, ReachesTheBayesLimitAsItSlowsDown) {
  const double limit = tuners.bayes_limit.health.sum();
  double previous = std::numeric_limits<double>::infinity();
  for (const double qh : {1e-2, 1e-4, 1e-6}) {
    const double ssee = tuner_design::gauss_markov_design(model, steady, tuner_design::gauss_markov_rho(model, qh))
                            .health_total_covariance.trace();
    EXPECT_GT(ssee, limit);
    EXPECT_LT(ssee, previous);
    previous = ssee;
  }
  EXPECT_NEAR(previous / limit, 1.0, 1e-3);
}

TEST_F(GaussMarkov, IsTheSteadyFilterOnAllHealthWithALeak) {
  // The recursion as it stands in the header, on the matrices of the design.
  ASSERT_EQ(theory.A(7, 7), rho);
  GaussMarkovFilter full = filter;
  Eigen::VectorXd estimate = Eigen::VectorXd::Zero(2 + 6);
  SensorVector dy(4);
  ActuatorVector u(1), previous = ActuatorVector::Zero(1);
  for (int k = 0; k < 200; ++k) {
    dy = random.normal_vector(4);
    u(0) = 0.02 * std::sin(0.05 * k);
    const bool lost = k % 7 == 0;
    estimate = theory.A * estimate + theory.B * previous;
    Eigen::VectorXd innovation = dy - theory.C * estimate - model.D * u;
    if (lost) innovation(2) = 0.0;
    estimate += theory.K * innovation;
    if (lost) dy(2) = std::numeric_limits<double>::quiet_NaN();
    full.predict(previous);
    full.innovation(dy, u);
    full.update(SensorMask(lost ? 0b1011 : 0b1111));
    previous = u;
  }
  const Eigen::VectorXd expected = estimate.tail(6);
  EXPECT_GT(expected.norm(), 0.1);
  EXPECT_LT((full.health() - expected).norm(), 1e-10 * expected.norm());
}

TEST_F(GaussMarkov, ErrorsOverTheFleetAreThoseOfTheTheory) {
  // Linear truth without process noise, constant health; 3.5 standard errors of a mean of squares, 8 channels.
  constexpr int engines = 1500, samples = 1500;
  ASSERT_LT(10.0 * theory.slowest_time_constant_s, samples * model.sample_time_s);
  GaussMarkovFilter full = filter;
  Eigen::VectorXd health = Eigen::VectorXd::Zero(6), auxiliary = Eigen::VectorXd::Zero(2);
  const ActuatorVector still = ActuatorVector::Zero(1);
  for (int engine = 0; engine < engines; ++engine) {
    const Eigen::VectorXd h = model.health_sigma.cwiseProduct(random.normal_vector(6));
    const Eigen::VectorXd y = steady.H * h;
    full.reset();
    for (int k = 0; k < samples; ++k) {
      full.predict(still);
      full.innovation(y + model.sensor_noise_sigma.cwiseProduct(random.normal_vector(4)), still);
      full.update(SensorMask{}.set());
    }
    health += (full.health() - h).cwiseAbs2();
    auxiliary += (full.auxiliary() - steady.Hz * h).cwiseAbs2();
  }
  const double tolerance = 3.5 * std::sqrt(2.0 / engines);
  const Eigen::VectorXd h_ratio = health.cwiseQuotient(theory.health_total_covariance.diagonal()) / engines;
  const Eigen::VectorXd z_ratio = auxiliary.cwiseQuotient(theory.auxiliary_total_covariance.diagonal()) / engines;
  EXPECT_LT((h_ratio.array() - 1.0).abs().maxCoeff(), tolerance);
  EXPECT_LT((z_ratio.array() - 1.0).abs().maxCoeff(), tolerance);
}

TEST_F(GaussMarkov, AllocatesNothing) {
  GaussMarkovFilter full = filter;
  const SensorVector y = SensorVector::Ones(4);
  const ActuatorVector u = ActuatorVector::Zero(1);
  const long before = test::allocation_count();
  for (int k = 0; k < 10; ++k) {
    full.predict(u);
    full.innovation(y, u);
    full.update(SensorMask(0b0111));
  }
  full.reset();
  EXPECT_EQ(test::allocation_count(), before);
}

TEST_F(GaussMarkov, RefusesAGainThatDoesNotFit) {
  GaussMarkovGain gain = tuner_design::gauss_markov_gain(theory, rho);
  gain.rho = 1.0;
  EXPECT_THROW(GaussMarkovFilter(full_order_model(model), gain), std::invalid_argument);
  gain.rho = rho;
  gain.K.resize(5, 4);
  EXPECT_THROW(GaussMarkovFilter(full_order_model(model), gain), std::invalid_argument);
}

}  // namespace
}  // namespace ehm::estimation
