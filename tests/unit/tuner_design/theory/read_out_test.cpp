// SPDX-License-Identifier: Apache-2.0
// What a model knows that it misses counts in the estimate: the read-out is the Bayes estimate on averaged readings, no
// other one errs less, and a model that misses nothing keeps the filter's own.

#include "tuner_design/theory/read_out.h"

#include <gtest/gtest.h>

#include <vector>

#include "deploy/runtime/numbers/decompositions.h"
#include "monitor/design/closed_loop.h"
#include "monitor/design/fleet_unknowns.h"
#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/design/choose_tuners.h"
#include "tuner_design/design/design_tuner.h"
#include "tuner_design/theory/bayes_limit.h"
#include "tuner_design/theory/kalman_error.h"
#include "tuner_design/theory/kalman_gain.h"

namespace ehm::tuner_design {
namespace {

using test::Random;

/// A made up engine that misses as much of sensors and outputs as a tenth of its health does.
linear_model::LinearModel knowing_model(std::uint64_t seed, int sensors = 4, int health = 7) {
  linear_model::LinearModel model = test::made_up_model(sensors, health);
  Random random(seed);
  const Eigen::Index size = sensors + 2;
  const Eigen::MatrixXd root = random.normal_matrix(size, size);
  const Eigen::VectorXd scale = (Eigen::VectorXd(size) << model.sensor_noise_sigma, 5.0, 50.0).finished();
  model.linearisation_error = 0.3 * scale.asDiagonal() * root * root.transpose() * scale.asDiagonal();
  return model;
}

/// On tuners drawn at random, of which none is special.
design::SubsetDesign filter_of(const PreparedPoint& point, Eigen::Index t, std::uint64_t seed, double qh_percent2) {
  const Eigen::MatrixXd V = Random(seed).normal_matrix(t, point.model.L.cols());
  design::SubsetDesign filter = kalman_gain(point.model, all_sensors(point.model), V, qh_percent2);
  add_error_theory(filter, point.model, point.steady);
  return filter;
}

TEST(ReadOut, OfAsManyTunersAsSensorsIsTheBayesEstimateWhateverTheTuners) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    SCOPED_TRACE(seed);
    const PreparedPoint point = prepare(knowing_model(seed));
    const design::SubsetDesign filter = filter_of(point, 4, seed, 1e-9);  // endless averaging
    const Eigen::Index t = 4;
    const Eigen::MatrixXd Ph = point.model.health_sigma.cwiseAbs2().asDiagonal();
    const Eigen::MatrixXd& H = point.steady.H;
    const Eigen::MatrixXd Lambda = point.model.linearisation_error.topLeftCorner(4, 4);
    // hhat = Ph H^T (H Ph H^T + Lambda)^-1 y, and q = (H W)^-1 y
    const Eigen::MatrixXd bayes = (H * Ph * H.transpose() + Lambda).llt().solve(H * Ph).transpose() * (H * filter.W);
    EXPECT_LT((filter.health_readout - bayes).norm(), 0.01 * bayes.norm());
    const design::FleetUnknowns unknowns = design::fleet_unknowns(point.model, point.steady);
    const design::ErrorByChannel limit = steady_limit(unknowns);
    EXPECT_NEAR(filter.health_total_covariance.trace() / limit.health.sum(), 1.0, 0.01);
    EXPECT_NEAR(filter.auxiliary_total_covariance.trace() / limit.auxiliary.sum(), 1.0, 0.01);
    EXPECT_GE(filter.health_total_covariance.trace(), limit.health.sum());
    EXPECT_EQ(filter.health_readout.cols(), t);
  }
}

TEST(ReadOut, NoOtherOneErrsLess) {
  for (const Eigen::Index t : {2, 4}) {
    SCOPED_TRACE(t);
    const PreparedPoint point = prepare(knowing_model(5));
    const design::SubsetDesign filter = filter_of(point, t, 9, 1e-3);
    const design::FleetUnknowns unknowns = design::fleet_unknowns(point.model, point.steady);
    const Eigen::MatrixXd X = design::settled(design::closed_loop(filter), filter.K * unknowns.sensors).bottomRows(t);
    const Eigen::MatrixXd S = design::tuner_noise(filter, point.model);
    const auto error = [&](const Eigen::MatrixXd& Rh) {
      return (Rh * X - unknowns.health).squaredNorm() + (Rh * S * Rh.transpose()).trace();
    };
    const double least = error(filter.health_readout);
    EXPECT_NEAR(least / filter.health_total_covariance.trace(), 1.0, 1e-9);
    EXPECT_LT(least, error(filter.W));
    Random random(4);
    for (int k = 0; k < 20; ++k) {
      const Eigen::MatrixXd other =
          filter.health_readout + 0.01 * random.normal_matrix(filter.W.rows(), filter.W.cols());
      EXPECT_GT(error(other), least);
    }
  }
}

TEST(ReadOut, AModelThatMissesNothingKeepsTheFiltersOwn) {
  const PreparedPoint point = prepare(test::made_up_model(4, 7));
  const design::SubsetDesign filter = filter_of(point, 4, 1, 1e-3);
  EXPECT_EQ(filter.health_readout, filter.W);
  EXPECT_EQ(filter.auxiliary_readout, point.model.N * filter.W);
}

TEST(ReadOut, IsPartOfADesignWhichSaysThatItWasNotSearched) {
  const design::Design design = design_tuner(knowing_model(6), {});
  EXPECT_EQ(design.full.V.rows(), 4);
  EXPECT_NE(design.full.health_readout, design.full.W);
  EXPECT_TRUE(design.certificate.starts.empty());
  EXPECT_NE(design.certificate.verdict.find("not searched"), std::string::npos) << design.certificate.verdict;
  EXPECT_GE(design.certificate.objective, design.certificate.lower_bound);
  const design::ErrorByChannel real = design.real_error();
  EXPECT_NEAR(real.health.sum() / design.full.health_total_covariance.trace(), 1.0, 1e-12);
  EXPECT_GE(real.health.sum(), design.bayes_limit.health.sum());
  // worse than the fleet's own spread no channel can be
  EXPECT_TRUE(worse_than_prior(design.full, design.model, design.scaling).empty());
}

}  // namespace
}  // namespace ehm::tuner_design
