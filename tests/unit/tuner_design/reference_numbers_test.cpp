// SPDX-License-Identifier: Apache-2.0
// The reference numbers of theory.md, section 5, JT9D at cruise: Ph 2 %, noise of [SG] table 2, process noise 1e-4
// percent^2.

#include <gtest/gtest.h>

#include "engine_sim/linear_model/discretise.h"
#include "engine_sim/linear_model/scaling.h"
#include "monitor/estimation/steady_gain.h"
#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/design/design_tuner.h"
#include "tuner_design/design/tuner_baselines.h"
#include "tuner_design/theory/kalman_error.h"
#include "tuner_design/theory/kalman_gain.h"

namespace ehm::tuner_design {
namespace {

constexpr double rankine2_per_kelvin2 = 3.24;

/// Sum over T40 and T50 in degR^2, Fn in percent^2 and SmLPC in points^2: the unit form of theory.md, section 5.
double auxiliary_total_rankine(const Eigen::VectorXd& ssee) {
  return rankine2_per_kelvin2 * (ssee(0) + ssee(1)) + ssee(2) + ssee(3);
}

class ReferenceNumbers : public ::testing::Test {
 protected:
  void SetUp() override {
    model = test::jt9d_cruise();
    scaled = linear_model::scaled(discretise(model), linear_model::scaling_of(model));
    steady = estimation::steady_gain(scaled);
  }
  design::Design designed(double qh) const {
    design::DesignOptions options;
    options.qh_percent2 = qh;
    options.tuning = design::Tuning::closed_form;
    return design_tuner(model, options);
  }
  /// Kalman filter on given tuners at Qh = 1e-5.
  design::SubsetDesign on_tuners(const Eigen::MatrixXd& V) const {
    design::SubsetDesign design = kalman_gain(scaled, {0, 1, 2, 3, 4, 5, 6}, V, 1e-5);
    add_error_theory(design, scaled, steady);
    return design;
  }
  linear_model::LinearModel model, scaled;
  estimation::SteadyGain steady;
};

TEST_F(ReferenceNumbers, AreOfTheReferenceDatasCruisePointToTenDigits) {
  const auto whole = test::jt9d_point("alt35000_MN0.8_PC100");
  if (!whole) GTEST_SKIP() << test::no_reference;
  using M = linear_model::LinearModel;
  for (const auto matrix : {&M::A, &M::B, &M::L, &M::C, &M::D, &M::M, &M::F, &M::G, &M::N})
    EXPECT_LT(((model.*matrix) - ((*whole).*matrix)).norm(), 1e-9 * (model.*matrix).norm());
  EXPECT_LT((model.sensor_noise_sigma - whole->sensor_noise_sigma).norm(), 1e-9 * model.sensor_noise_sigma.norm());
}

TEST_F(ReferenceNumbers, FullAndReducedMap) {
  const design::Design design = designed(1e-3);
  EXPECT_NEAR(design.full_map.health.sum() / 19.717, 1.0, 1e-4);
  // The closed form loses nothing: equal for health and for the auxiliary outputs, channel by channel.
  EXPECT_NEAR(design.reduced_map.health.sum() / design.full_map.health.sum(), 1.0, 1e-9);
  EXPECT_TRUE(design.reduced_map.health.isApprox(design.full_map.health, 1e-9));
  EXPECT_TRUE(design.reduced_map.auxiliary.isApprox(design.full_map.auxiliary, 1e-9));
}

TEST_F(ReferenceNumbers, BayesLimit) {
  const design::Design design = designed(1e-3);
  EXPECT_NEAR(design.bayes_limit.health.sum() / 12.000, 1.0, 1e-4);
  EXPECT_NEAR(auxiliary_total_rankine(design.bayes_limit.auxiliary) / 103.695, 1.0, 1e-4);
  // T40 can be known exactly at this point (theory.md, section 5: 4e-11 percent^2).
  EXPECT_LT(design.bayes_limit.auxiliary(0), 1e-9);
}

TEST_F(ReferenceNumbers, KalmanAtTheReferenceQh) {
  const design::Design design = designed(1e-5);
  // theory.md, section 5, with the process noise of the model in the error; digits from numpy and scipy. Without it 12.015
  // and 104.27: finite_window_test.cpp.
  EXPECT_NEAR(design.ssee.health.sum() / 12.016144, 1.0, 1e-6);
  EXPECT_NEAR(auxiliary_total_rankine(design.ssee.auxiliary) / 104.622539, 1.0, 1e-6);
  EXPECT_NEAR(design.full.slowest_time_constant_s, 19.9, 0.05);
  // By channel, reporting units, with one V.
  EXPECT_EQ(design.scaling.auxiliary_unit, (std::vector<std::string>{"K", "K", "percent", "points"}));
  EXPECT_TRUE(design.ssee.auxiliary.isApprox(Eigen::Vector4d(0.17960895, 31.16767363, 1.85727936, 1.20006364), 1e-6));
}

TEST_F(ReferenceNumbers, StrongProcessNoiseIsInTheSigma) {
  // (0.3 % of trim)^2 a sample, V = H Ph, Qh 1e-3: numpy and scipy (solve_discrete_are, solve_discrete_lyapunov).
  model.process_noise *= 900.0;
  const design::Design design = designed(1e-3);
  const Eigen::VectorXd noise = design.full.health_noise_covariance.diagonal().cwiseSqrt();
  EXPECT_NEAR(noise(5), 0.3397, 1e-4) << "HPC_flow, percent; without process noise 0.1448";
  EXPECT_NEAR(noise(7), 0.2663, 1e-4) << "HPT_flow, percent; without process noise 0.1039";
  EXPECT_NEAR(std::sqrt(design.full.auxiliary_noise_covariance(0, 0)), 2.37152, 1e-4) << "T40, K; without 1.40923";
  EXPECT_NEAR(design.ssee.health.sum() / 12.602902, 1.0, 1e-6);
}

TEST_F(ReferenceNumbers, KalmanAtTheFlyingQh) {
  const design::Design design = designed(1e-3);
  EXPECT_NEAR(design.ssee.health.sum() / 12.162604, 1.0, 1e-6);
  EXPECT_NEAR(auxiliary_total_rankine(design.ssee.auxiliary) / 108.489011, 1.0, 1e-6);
  EXPECT_NEAR(design.full.slowest_time_constant_s, 2.0, 0.05);
}

TEST_F(ReferenceNumbers, SubsetBaseline) {
  const Eigen::MatrixXd V =
      subset_tuners(model, {"FAN_flow", "LPC_eff", "HPC_eff", "HPC_flow", "HPT_eff", "HPT_flow", "LPT_flow"});
  const design::SubsetDesign design = on_tuners(V);
  EXPECT_NEAR(design.health_total_covariance.trace() / 106.995882, 1.0, 1e-6);  // digits from numpy and scipy
  EXPECT_NEAR(auxiliary_total_rankine(design.auxiliary_total_covariance.diagonal()) / 274.590473, 1.0, 1e-6);
}

TEST_F(ReferenceNumbers, SvdBaseline) {
  // [H; Hz] with temperatures in degR, as the reference was made.
  const Eigen::MatrixXd Hz_rankine = Eigen::Vector4d(1.8, 1.8, 1.0, 1.0).asDiagonal() * steady.Hz;
  const design::SubsetDesign design = on_tuners(svd_tuners(steady.H, Hz_rankine, 7));
  EXPECT_NEAR(design.health_total_covariance.trace() / 96.061564, 1.0, 1e-6);  // digits from numpy and scipy
  EXPECT_NEAR(auxiliary_total_rankine(design.auxiliary_total_covariance.diagonal()) / 1755.993421, 1.0, 1e-6);
}

TEST_F(ReferenceNumbers, OneHundredTimesSmallerNoiseReachesTheLimit) {
  model.sensor_noise_sigma *= 0.01;
  model.process_noise *= 1e-4;
  const design::Design design = designed(1e-9);
  EXPECT_NEAR(design.ssee.health.sum() / design.bayes_limit.health.sum(), 1.0, 1e-4);
}

TEST_F(ReferenceNumbers, EveryMissingSensorHasADesignBelowThePrior) {
  const design::Design design = designed(1e-3);
  ASSERT_EQ(design.missing.size(), 7U);
  for (const auto& subset : design.missing) {
    ASSERT_TRUE(subset.has_value());
    EXPECT_EQ(subset->V.rows(), 6);
    EXPECT_GE(subset->health_total_covariance.trace(), design.ssee.health.sum());
    EXPECT_LT(subset->health_total_covariance.diagonal().maxCoeff(), 4.0) << "prior: (2 %)^2";
  }
}

TEST_F(ReferenceNumbers, DetectabilityOfASlowBias) {
  // 5 sigma_i sqrt([(H Ph H^T + (R + J Q J^T)/N)^-1]_ii), from numpy, N = 132.4.
  const Eigen::VectorXd expected{{0.947028, 2.422752, 2.057205, 9.303066, 1.687332, 5.445366, 5.861990}};
  const Eigen::VectorXd found = designed(1e-3).certificate.slow_bias_detectability;
  ASSERT_EQ(found.size(), 7);
  for (Eigen::Index i = 0; i < 7; ++i) EXPECT_NEAR(found(i) / expected(i), 1.0, 1e-5) << model.sensors[i].name;
}

TEST_F(ReferenceNumbers, Mapss) {
  const auto all = test::mapss();
  if (!all) GTEST_SKIP() << test::no_reference;
  design::DesignOptions options;
  options.tuning = design::Tuning::closed_form;
  const design::Design unreduced = design_tuner(*all, options);
  EXPECT_TRUE(unreduced.full.V.isIdentity());
  EXPECT_EQ(unreduced.bayes_limit.health.sum(), 0.0) << "eleven sensors see all eight health parameters";
  // Without y7 one combination is hardly seen: with eight tuners SSEE would be 5444, far above the prior of 32.
  ASSERT_TRUE(unreduced.missing[7].has_value());
  EXPECT_EQ(unreduced.missing[7]->V.rows(), 7);
  EXPECT_LT(unreduced.missing[7]->health_total_covariance.diagonal().maxCoeff(), 4.0);
  const auto few = test::mapss({0, 1, 3, 5, 7});
  const design::Design reduced = design_tuner(*few, options);
  EXPECT_EQ(reduced.full.V.rows(), 5);
  // Three of eight directions stay at the prior of (2 %)^2.
  EXPECT_NEAR(reduced.bayes_limit.health.sum() / (3 * 4.0), 1.0, 1e-9);
  EXPECT_GE(reduced.ssee.health.sum(), reduced.bayes_limit.health.sum());
  EXPECT_NEAR(reduced.reduced_map.health.sum() / reduced.full_map.health.sum(), 1.0, 1e-9);
}

}  // namespace
}  // namespace ehm::tuner_design
