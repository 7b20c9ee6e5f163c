// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/linear_model/discretise.h"

#include <gtest/gtest.h>

#include "monitor/estimation/steady_gain.h"
#include "tests/unit/tuner_design/test_models.h"

namespace ehm::linear_model {
namespace {

LinearModel continuous_model() {
  LinearModel model = test::made_up_model();
  model.discrete = false;
  model.A = (Eigen::Matrix2d() << -1.74, 1.79, 1.11, -4.74).finished();
  return model;
}

TEST(Discretise, AgreesWithThePowerSeries) {
  // Ad = sum (A T)^k / k!,  Bd = T sum (A T)^k / (k+1)! B: summed here until the terms vanish.
  const LinearModel model = continuous_model();
  const LinearModel discrete = discretise(model);
  const double T = model.sample_time_s;
  Eigen::MatrixXd term = Eigen::MatrixXd::Identity(2, 2), Ad = term, integral = T * term;
  for (int k = 1; k < 20; ++k) {
    term = (term * model.A * T / k).eval();
    Ad += term;
    integral += T / (k + 1) * term;
  }
  EXPECT_TRUE(discrete.discrete);
  EXPECT_LT((discrete.A - Ad).norm(), 1e-14);
  EXPECT_LT((discrete.B - integral * model.B).norm() / discrete.B.norm(), 1e-14);
  EXPECT_LT((discrete.L - integral * model.L).norm() / discrete.L.norm(), 1e-14);
  EXPECT_EQ(discrete.process_noise, model.process_noise) << "already per sample";
}

TEST(Discretise, KeepsTheSteadyState) {
  const LinearModel model = continuous_model();
  const estimation::SteadyGain before = estimation::steady_gain(model),
                               after = estimation::steady_gain(discretise(model));
  EXPECT_LT((before.H - after.H).norm() / before.H.norm(), 1e-12);
  EXPECT_LT((before.Hz - after.Hz).norm() / before.Hz.norm(), 1e-12);
}

TEST(Discretise, LeavesADiscreteModelAlone) {
  const LinearModel model = test::made_up_model();
  EXPECT_EQ(discretise(model).A, model.A);
}

}  // namespace
}  // namespace ehm::linear_model
