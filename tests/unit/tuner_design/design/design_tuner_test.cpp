// SPDX-License-Identifier: Apache-2.0
// Properties that every design must have.

#include "tuner_design/design/design_tuner.h"

#include <gtest/gtest.h>

#include "deploy/runtime/numbers/decompositions.h"
#include "engine_sim/linear_model/discretise.h"
#include "monitor/estimation/steady_gain.h"
#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/print/design_text.h"
#include "tuner_design/search/row_space.h"
#include "tuner_design/theory/kalman_error.h"
#include "tuner_design/theory/kalman_gain.h"

namespace ehm::tuner_design {
namespace {

using design::Design;
using design::SubsetDesign;

TEST(RowSpace, IsOrthonormalAndDependsOnlyOnTheRowSpace) {
  test::Random random(11);
  const Eigen::MatrixXd V = random.normal_matrix(4, 7), T = random.normal_matrix(4, 4);
  const Eigen::MatrixXd a = row_space(V), b = row_space(T * V);
  EXPECT_TRUE((a * a.transpose()).isIdentity(1e-14));
  EXPECT_LT((a.transpose() * a - b.transpose() * b).norm(), 1e-12) << "equal projectors";
  EXPECT_GT(a.row(0).dot(V.row(0)), 0.0) << "sign follows the first row";
}

TEST(DesignTuner, TunersMayBeTransformedWithoutEffect) {
  // V -> T V changes nothing that anyone can observe (theory.md, section 2).
  const linear_model::LinearModel model = test::made_up_model();
  const linear_model::LinearModel scaled = linear_model::scaled(model, linear_model::scaling_of(model));
  const estimation::SteadyGain steady = estimation::steady_gain(scaled);
  const Eigen::MatrixXd V = row_space(steady.H);
  test::Random random(12);
  SubsetDesign a = kalman_gain(scaled, {0, 1, 2, 3}, V, 1e-3);
  SubsetDesign b = kalman_gain(scaled, {0, 1, 2, 3}, random.normal_matrix(4, 4) * V, 1e-3);
  add_error_theory(a, scaled, steady);
  add_error_theory(b, scaled, steady);
  EXPECT_TRUE(a.health_total_covariance.isApprox(b.health_total_covariance, 1e-9));
  EXPECT_TRUE(a.auxiliary_total_covariance.isApprox(b.auxiliary_total_covariance, 1e-9));
  EXPECT_TRUE(a.health_filter_covariance.isApprox(b.health_filter_covariance, 1e-9));
  EXPECT_TRUE(a.innovation_variance.isApprox(b.innovation_variance, 1e-9));
  EXPECT_NEAR(a.slowest_time_constant_s, b.slowest_time_constant_s, 1e-9);
}

TEST(DesignTuner, BiasIsTheObliqueProjection) {
  // The tuners integrate, so that the mean residual is zero: hhat -> W (H W)^-1 H h (theory.md, section 4).
  const linear_model::LinearModel model = test::made_up_model();
  const Design design = design_tuner(model, {});
  const linear_model::LinearModel scaled = linear_model::scaled(model, design.scaling);
  const Eigen::MatrixXd H = estimation::steady_gain(scaled).H;
  const Eigen::MatrixXd& W = design.full.W;
  const Eigen::MatrixXd bias = W * (H * W).partialPivLu().solve(H) - Eigen::MatrixXd::Identity(6, 6);
  const Eigen::MatrixXd expected = bias * 4.0 * bias.transpose() + design.full.health_noise_covariance;
  EXPECT_LT((design.full.health_total_covariance - expected).norm() / expected.norm(), 1e-9);
}

TEST(DesignTuner, NeverBeatsTheLimitAndApproachesItSlowly) {
  const linear_model::LinearModel model = test::made_up_model();
  double previous = 1e9;
  for (const double qh : {1e-2, 1e-3, 1e-4, 1e-5}) {
    design::DesignOptions options;
    options.qh_percent2 = qh;
    const Design design = design_tuner(model, options);
    EXPECT_TRUE((design.ssee.health.array() >= design.bayes_limit.health.array()).all());
    EXPECT_LT(design.ssee.health.sum(), previous) << "smaller Qh, slower and nearer";
    previous = design.ssee.health.sum();
  }
  EXPECT_NEAR(previous / design_tuner(model, {}).bayes_limit.health.sum(), 1.0, 0.01);
}

TEST(DesignTuner, UnitsOfTheFileDoNotMatter) {
  // The same engine with health in percent, temperature in K, thrust in N: the same design in reporting units.
  const linear_model::LinearModel model = test::made_up_model();
  linear_model::LinearModel other = model;
  for (auto& channel : other.health) channel.unit = "%";
  for (Eigen::MatrixXd* matrix : {&other.L, &other.M, &other.N}) *matrix /= 100.0;
  other.health_sigma *= 100.0;
  const double newton_per_lbf = 4.4482216152605;
  other.auxiliary = {{"T40", "K", model.auxiliary[0].trim / 1.8},
                     {"Fn", "N", model.auxiliary[1].trim * newton_per_lbf}};
  for (Eigen::MatrixXd* matrix : {&other.F, &other.G, &other.N}) {
    matrix->row(0) /= 1.8;
    matrix->row(1) *= newton_per_lbf;
  }
  const Design a = design_tuner(model, {}), b = design_tuner(other, {});
  EXPECT_TRUE(a.ssee.health.isApprox(b.ssee.health, 1e-9));
  EXPECT_TRUE(a.ssee.auxiliary.isApprox(b.ssee.auxiliary, 1e-9));
}

TEST(DesignTuner, EnoughSensorsNeedNoReduction) {
  const Design design = design_tuner(test::made_up_model(6, 4), {});
  EXPECT_TRUE(design.full.V.isIdentity());
  EXPECT_EQ(design.bayes_limit.health.sum(), 0.0);
  EXPECT_EQ(design_as_json(design).at("reduction"), "none, V = I: at least as many sensors as health parameters");
  for (const auto& subset : design.missing) EXPECT_TRUE(subset.has_value());
}

TEST(DesignTuner, OneSensorHasNoDesignWithoutIt) {
  const Design design = design_tuner(test::made_up_model(1, 3), {});
  ASSERT_EQ(design.missing.size(), 1U);
  EXPECT_FALSE(design.missing[0].has_value());
  EXPECT_TRUE(design_as_json(design).at("without_sensor").at("N1").is_null());
}

TEST(DesignTuner, AnAbsentSensorNeverMakesItWorseThanThePrior) {
  for (const auto& [sensors, health] : {std::pair{4, 6}, {6, 4}, {5, 5}, {8, 7}}) {
    const Design design = design_tuner(test::made_up_model(sensors, health), {});
    for (const auto& subset : design.missing) {
      ASSERT_TRUE(subset.has_value());
      EXPECT_LE(subset->health_total_covariance.diagonal().maxCoeff(), 4.0) << sensors << ' ' << health;
    }
  }
}

// An EGT margin is the EGT turned round: the sensors know it, and what the linear model misses of it cancels but for what
// the read-out leaves to the noise, and round-off, which once was a negative variance that the monitor refused.
TEST(DesignTuner, AnOutputThatIsASensorTurnedRoundHasNoNegativeVariance) {
  constexpr Eigen::Index turned = 2;  // its unit of percent is 7 K: no power of two, so that products round
  linear_model::LinearModel model = test::made_up_model();
  model.auxiliary[1] = {"margin", "K", 100.0};
  model.F.row(1) = -model.C.row(turned);
  model.G.row(1) = -model.D.row(turned);
  model.N.row(1) = -model.M.row(turned);
  design::DesignOptions options;
  options.tuning = design::Tuning::closed_form;
  test::Random random(31);
  for (int draw = 0; draw < 20; ++draw) {
    Eigen::MatrixXd root = random.normal_matrix(6, 6);
    root.row(5) = -root.row(turned);
    model.linearisation_error = root * root.transpose();
    const Design design = design_tuner(model, options);
    EXPECT_GE(design.full.auxiliary_linearisation_covariance(1, 1), 0.0) << draw;
    EXPECT_LT(design.full.auxiliary_linearisation_covariance(1, 1), 0.1 * design.full.auxiliary_noise_covariance(1, 1))
        << draw;
    for (const auto& subset : design.missing) {
      ASSERT_TRUE(subset.has_value());
      EXPECT_GE(subset->auxiliary_linearisation_covariance.diagonal().minCoeff(), 0.0) << draw;
    }
  }
}

TEST(DesignTuner, RefusesQhOfZero) {
  design::DesignOptions options;
  options.qh_percent2 = 0.0;
  EXPECT_THROW(design_tuner(test::made_up_model(), options), std::invalid_argument);
}

TEST(DesignReport, JsonCarriesTotalsByChannelAndRowSpace) {
  const Design design = design_tuner(test::made_up_model(), {});
  const auto json = design_as_json(design);
  for (const char* key : {"ssee_health", "ssee_auxiliary", "bayes_limit_health", "bayes_limit_auxiliary"}) {
    double sum = 0.0;
    for (const auto& value : json.at(key).at("by_channel")) sum += value.get<double>();
    EXPECT_NEAR(sum, json.at(key).at("total").get<double>(), 1e-12) << key;
  }
  EXPECT_EQ(json.at("ssee_auxiliary").at("by_channel").at("T40").get<double>(), design.ssee.auxiliary(0));
  EXPECT_EQ(json.at("row_space").size(), 4U);
  EXPECT_EQ(json.at("row_space").at(0).size(), 6U);
  EXPECT_GT(json.at("slowest_time_constant_s").get<double>(), 0.0);
}

}  // namespace
}  // namespace ehm::tuner_design
