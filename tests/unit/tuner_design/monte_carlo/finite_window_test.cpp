// SPDX-License-Identifier: Apache-2.0
// Theory of a finite window: against the figures of theory.md, section 4, against the monitor's own error propagation, and
// in its limits.

#include "tuner_design/monte_carlo/finite_window.h"

#include <gtest/gtest.h>

#include "monitor/design/make_error_model.h"
#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/design/design_tuner.h"

namespace ehm::tuner_design {
namespace {

design::Design made_up_design(double qh_percent2, bool with_linearisation_error) {
  linear_model::LinearModel model = test::made_up_model();
  if (with_linearisation_error) {
    test::Random random(9);
    Eigen::VectorXd size(6);
    size << model.sensor_noise_sigma, 5.0, 50.0;
    const Eigen::MatrixXd root = 0.2 * size.asDiagonal() * random.normal_matrix(6, 6);
    model.linearisation_error = root * root.transpose();
  }
  design::DesignOptions options;
  options.qh_percent2 = qh_percent2;
  return design_tuner(model, options);
}

TEST(FiniteWindow, IsTheReferenceAtTheReferenceQh) {
  design::DesignOptions options;
  options.qh_percent2 = 1e-5;
  const design::Design design = design_tuner(test::jt9d_cruise(), options);
  const Window window = window_of(30.0, 10.0, 0.015);
  const WindowError error = finite_window_error(design, window, true),
                    still = finite_window_error(design, window, false);
  // theory.md, section 4: h 12.44, z 108.2 with temperatures in degR of an engine in balance; the recursion in numpy for
  // V = H Ph gives 12.4379, 108.165, and with process noise 12.4390, 108.513. The search moves V a little.
  const auto rankine = [](const Eigen::VectorXd& z) { return 3.24 * (z(0) + z(1)) + z(2) + z(3); };
  EXPECT_NEAR(still.linear.health.sum(), 12.44, 0.005);
  EXPECT_NEAR(rankine(still.linear.auxiliary), 108.2, 0.05);
  EXPECT_NEAR(error.linear.health.sum() - still.linear.health.sum(), 12.439014 - 12.437889, 1e-4);
  EXPECT_NEAR(rankine(error.linear.auxiliary) - rankine(still.linear.auxiliary), 108.513296 - 108.164809, 5e-3);
  EXPECT_GT(error.linear.health.sum(), 1.03 * design.ssee.health.sum());
}

TEST(FiniteWindow, AnEngineInBalanceHasTheErrorOfTheory) {
  // The filter is made for the model's Q, the engine then stays in balance: the figures of theory.md, section 5.
  design::DesignOptions options;
  options.qh_percent2 = 1e-5;
  options.tuning = design::Tuning::closed_form;
  const design::ErrorByChannel still = settled_error(design_tuner(test::jt9d_cruise(), options), false);
  EXPECT_NEAR(still.health.sum() / 12.0150156, 1.0, 1e-7);
  EXPECT_NEAR((3.24 * (still.auxiliary(0) + still.auxiliary(1)) + still.auxiliary(2) + still.auxiliary(3)) / 104.273995,
              1.0, 1e-7);
}

TEST(FiniteWindow, IsTheMeanOfThePublishedVariances) {
  const design::Design design = made_up_design(1e-4, true);
  ASSERT_GT(design.linearisation.health.sum(), 0.0);
  const Window window = window_of(6.0, 4.0, 0.015);
  const estimation::ErrorModel model = design::make_error_model(design, design.full);
  estimation::ErrorPropagation published(model);
  Eigen::VectorXd health = Eigen::VectorXd::Zero(6), auxiliary = Eigen::VectorXd::Zero(2);
  for (int k = 0; k < window.samples; ++k) {
    published.step();
    if (k < window.first()) continue;
    health += published.health_sigma().cwiseQuotient(design.scaling.health).cwiseAbs2() / window.averaged;
    auxiliary += published.auxiliary_sigma().cwiseQuotient(design.scaling.auxiliary).cwiseAbs2() / window.averaged;
  }
  const WindowError error = finite_window_error(design, window, true);
  EXPECT_TRUE(health.isApprox(error.linear.health + error.linearisation.health, 1e-9));
  EXPECT_TRUE(auxiliary.isApprox(error.linear.auxiliary + error.linearisation.auxiliary, 1e-9));
}

TEST(FiniteWindow, EndsAtTheSettledErrorWithAndWithoutProcessNoise) {
  const design::Design design = made_up_design(1e-2, true);
  for (const bool process_noise : {false, true}) {
    SCOPED_TRACE(process_noise);
    const WindowError late = finite_window_error(design, window_of(200.0, 0.015, 0.015), process_noise);
    const design::ErrorByChannel settled = settled_error(design, process_noise);
    EXPECT_TRUE(late.linear.health.isApprox(settled.health, 1e-7));
    EXPECT_TRUE(late.linear.auxiliary.isApprox(settled.auxiliary, 1e-7));
    EXPECT_TRUE(late.linearisation.health.isApprox(design.linearisation.health, 1e-7));
    EXPECT_TRUE(late.linearisation.auxiliary.isApprox(design.linearisation.auxiliary, 1e-7));
  }
}

TEST(FiniteWindow, ProcessNoiseOnlyAdds) {
  const design::Design design = made_up_design(1e-2, false);
  const Window window = window_of(3.0, 1.0, 0.015);
  const design::ErrorByChannel quiet = finite_window_error(design, window, false).linear;
  const design::ErrorByChannel noisy = finite_window_error(design, window, true).linear;
  EXPECT_TRUE((noisy.health.array() > quiet.health.array()).all());
  EXPECT_TRUE((noisy.auxiliary.array() > quiet.auxiliary.array()).all());
}

TEST(FiniteWindow, RefusesWindowsThatDoNotFit) {
  for (const auto& [seconds, window] : {std::pair{1.0, 2.0}, {0.0, 0.0}, {10.0, 0.001}, {1e6, 1.0}, {10.0, -1.0}}) {
    SCOPED_TRACE(testing::Message() << seconds << " s, " << window << " s");
    EXPECT_THROW(window_of(seconds, window, 0.015), std::invalid_argument);
  }
  EXPECT_EQ(window_of(30.0, 10.0, 0.015).samples, 2000);
  EXPECT_EQ(window_of(30.0, 10.0, 0.015).averaged, 667);
}

}  // namespace
}  // namespace ehm::tuner_design
