// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/linear_model/scaling.h"

#include <gtest/gtest.h>

#include "monitor/estimation/steady_gain.h"
#include "tests/unit/tuner_design/test_models.h"

namespace ehm::linear_model {
namespace {

LinearModel with_auxiliary(const Channel& channel) {
  LinearModel model;
  model.auxiliary = {channel};
  return model;
}

TEST(Scaling, AuxiliaryOutputsHaveReportingUnits) {
  struct Case {
    const char* unit;
    double trim, scale;
    const char* reporting;
  };
  // 1 degR is 5/9 K; thrust of 200 lbf is reported in percent, that is in steps of 2 lbf.
  for (const Case& c : {Case{"K", 1300, 1, "K"},
                        {"degC", 0, 1, "K"},
                        {"degR", 2350, 1.8, "K"},
                        {"R", 2350, 1.8, "K"},
                        {"percent", 23, 1, "points"},
                        {"%", 23, 1, "points"},
                        {"points", 0, 1, "points"},
                        {"fraction", 0.2, 0.01, "points"},
                        {"lbf", -200, 2, "percent"},
                        {"N", 47000, 470, "percent"}}) {
    SCOPED_TRACE(c.unit);
    const Scaling scaling = scaling_of(with_auxiliary({"z", c.unit, c.trim}));
    EXPECT_DOUBLE_EQ(scaling.auxiliary(0), c.scale);
    EXPECT_EQ(scaling.auxiliary_unit[0], c.reporting);
  }
}

TEST(Scaling, ZeroTrimAndUnknownUnitsAreRefused) {
  try {
    scaling_of(with_auxiliary({"Fn", "N", 0.0}));
    FAIL() << "thrust without trim was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(
        error.what(),
        "auxiliary output Fn in N has trim 0; allowed: non-zero, since its error is reported in percent of trim");
  }
  LinearModel model;
  model.health = {{"eff", "points", 0.0}};
  try {
    scaling_of(model);
    FAIL() << "health in points was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "health parameter eff has unit 'points'; allowed: fraction, -, percent, %");
  }
}

TEST(Scaling, StatesAndSensorsWithoutTrim) {
  LinearModel model;
  model.states = {{"N1", "rpm", 3650.0}, {"x", "-", 0.0}};
  model.sensors = {{"T", "K", 500.0}, {"y", "-", 0.0}};
  model.sensor_noise_sigma = Eigen::Vector2d(3.0, 0.25);
  const Scaling scaling = scaling_of(model);
  EXPECT_EQ(scaling.state, Eigen::Vector2d(36.5, 1.0));
  EXPECT_EQ(scaling.sensor, Eigen::Vector2d(5.0, 0.25)) << "noise sigma where the trim is 0";
}

TEST(Scaling, ATemperatureCountsFromAbsoluteZeroWhateverItsUnit) {
  // 4 degC = 277.15 K = 39.2 degF = 498.87 degR; a hundredth of it is 2.7715 K, or 4.9887 degF or degR.
  EXPECT_DOUBLE_EQ(size_of_trim({"T", "K", 277.15}), 277.15);
  EXPECT_DOUBLE_EQ(size_of_trim({"T", "degC", 4.0}), 277.15);
  EXPECT_DOUBLE_EQ(size_of_trim({"T", "C", -10.0}), 263.15);
  EXPECT_NEAR(size_of_trim({"T", "degF", 39.2}), 498.87, 1e-10);
  EXPECT_DOUBLE_EQ(size_of_trim({"T", "degR", 498.87}), 498.87);
  EXPECT_DOUBLE_EQ(percent_of_trim({"T", "degC", 0.0}, 0.1), 2.7315);
  EXPECT_DOUBLE_EQ(size_of_trim({"x", "", -3.0}), 3.0) << "no unit";
  EXPECT_DOUBLE_EQ(size_of_trim({"N", "rpm", 3650.0}), 3650.0);
}

TEST(Scaling, AGaugePressureHasNoSize) {
  for (const char* unit : {"psig", "barg", "kPag", "kPa(g)"}) {
    EXPECT_EQ(size_of_trim({"P", unit, 14.7}), 0.0) << unit;
    EXPECT_EQ(percent_of_trim({"P", unit, 14.7}, 0.25), 0.25) << unit;
  }
  const Scaling scaling = scaling_of(with_auxiliary({"P", "psig", 0.1}));
  EXPECT_EQ(scaling.auxiliary(0), 1.0);
  EXPECT_EQ(scaling.auxiliary_unit[0], "psig");
}

TEST(Scaling, PercentWithoutTrimStaysAsItIs) {
  LinearModel model;
  model.states = {{"N1", "percent", 0.0}, {"N2", "%", 95.0}};
  model.sensors = {{"T", "%", 0.0}, {"N2", "percent", 95.0}};
  model.sensor_noise_sigma = Eigen::Vector2d(0.75, 0.25);
  const Scaling scaling = scaling_of(model);
  EXPECT_EQ(scaling.state, Eigen::Vector2d(1.0, 0.95)) << "95 % of maximum speed is a trim like any other";
  EXPECT_EQ(scaling.sensor, Eigen::Vector2d(1.0, 0.95));
}

TEST(Scaling, ScaledModelIsTheSameModel) {
  const LinearModel model = test::made_up_model();
  const Scaling scaling = scaling_of(model);
  const LinearModel scaled_model = scaled(model, scaling);
  const estimation::SteadyGain a = estimation::steady_gain(model), b = estimation::steady_gain(scaled_model);
  EXPECT_LT((a.H * scaling.health.asDiagonal() - scaling.sensor.asDiagonal() * b.H).norm() / a.H.norm(), 1e-14);
  EXPECT_LT((a.Hz * scaling.health.asDiagonal() - scaling.auxiliary.asDiagonal() * b.Hz).norm() / a.Hz.norm(), 1e-14);
  EXPECT_TRUE(scaled_model.process_noise.isApprox(1e-4 * Eigen::MatrixXd::Identity(2, 2), 1e-12));
  EXPECT_TRUE(scaled_model.health_sigma.isApproxToConstant(2.0));
  EXPECT_TRUE(scaled_model.sensor_noise_sigma.isApproxToConstant(0.5));
}

TEST(SteadyGain, OneStateByHand) {
  // x+ = 0.5 x + 2 h, y = 3 x + h, z = x: X = 4, H = 13, Hz = 4.
  LinearModel model;
  const auto scalar = [](double value) { return Eigen::MatrixXd::Constant(1, 1, value); };
  model.A = scalar(0.5), model.L = scalar(2.0), model.C = scalar(3.0), model.M = scalar(1.0);
  model.F = scalar(1.0), model.N = scalar(0.0);
  const estimation::SteadyGain gain = estimation::steady_gain(model);
  EXPECT_DOUBLE_EQ(gain.X(0, 0), 4.0);
  EXPECT_DOUBLE_EQ(gain.H(0, 0), 13.0);
  EXPECT_DOUBLE_EQ(gain.Hz(0, 0), 4.0);
  // Continuous: 0 = -0.5 x + 2 h.
  model.discrete = false;
  model.A = scalar(-0.5);
  EXPECT_DOUBLE_EQ(estimation::steady_gain(model).H(0, 0), 13.0);
  model.A = scalar(0.0);
  EXPECT_THROW(estimation::steady_gain(model), std::runtime_error) << "an integrator has no steady state";
}

}  // namespace
}  // namespace ehm::linear_model
