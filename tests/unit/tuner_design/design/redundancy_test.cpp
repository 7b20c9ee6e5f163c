// SPDX-License-Identifier: Apache-2.0
// Sensors that repeat each other, or see nothing: rank decides how many tuners there are, and an extra probe never
// makes the filter slower or worse. Expected errors come from the design without the extra probe, or from weighting:
// two equal probes are one with the sum of their information, so that 1/sigma^2 adds up.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"
#include "monitor/design/design_file.h"
#include "monitor/design/make_filter.h"
#include "monitor/diagnosis/fault_signatures.h"
#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/design/design_tuner.h"
#include "tuner_design/design/tuner_number.h"
#include "tuner_design/print/design_text.h"
#include "tuner_design/sensors/sensor_set.h"

namespace ehm::tuner_design {
namespace {

using design::Design;
using linear_model::LinearModel;

/// The model with one more sensor: a row of weights on the others, and its noise.
LinearModel with_probe(LinearModel model, const std::string& name, const Eigen::RowVectorXd& of, double noise_sigma) {
  const Eigen::Index m = model.C.rows();
  linear_model::Channel channel = model.sensors.back();
  channel.name = name;
  channel.trim = 0.0;
  for (Eigen::Index i = 0; i < m; ++i) channel.trim += of(i) * model.sensors[as_size(i)].trim;
  model.sensors.push_back(channel);
  for (Eigen::MatrixXd* matrix : {&model.C, &model.D, &model.M}) {
    matrix->conservativeResize(m + 1, Eigen::NoChange);
    matrix->row(m) = of * matrix->topRows(m);
  }
  model.sensor_noise_sigma.conservativeResize(m + 1);
  model.sensor_noise_sigma(m) = noise_sigma;
  return model;
}

Eigen::RowVectorXd row(const LinearModel& model, std::size_t sensor) {
  return Eigen::RowVectorXd::Unit(model.C.rows(), as_index(sensor));
}

LinearModel with_twin(const LinearModel& model, std::size_t of, double noise_share = 1.0) {
  return with_probe(model, model.sensors[of].name + "_2_" + std::to_string(model.sensors.size()), row(model, of),
                    noise_share * model.sensor_noise_sigma(as_index(of)));
}

Design closed_form(const LinearModel& model, double qh = 1e-3) {
  design::DesignOptions options;
  options.tuning = design::Tuning::closed_form;
  options.qh_percent2 = qh;
  return design_tuner(model, options);
}

void expect_not_worse(const Design& with, const Design& without, Eigen::Index tuners) {
  EXPECT_EQ(with.full.V.rows(), tuners);
  EXPECT_LE(with.ssee.health.sum(), without.ssee.health.sum() * (1.0 + 1e-9));
  // Where the filter is as fast as the engine itself its poles move together, by some 0.2 % at 0.15 s.
  EXPECT_LE(with.full.slowest_time_constant_s, without.full.slowest_time_constant_s * 1.005);
}

TEST(Redundancy, TwoEqualProbesAreOneOfHalfTheVariance) {
  const LinearModel model = test::made_up_model(5, 7);
  LinearModel better = model;
  better.sensor_noise_sigma(3) /= std::sqrt(2.0);
  const Design with = closed_form(with_twin(model, 3)), expected = closed_form(better);
  expect_not_worse(with, closed_form(model), 5);
  EXPECT_NEAR(with.ssee.health.sum() / expected.ssee.health.sum(), 1.0, 1e-9);
  EXPECT_NEAR(with.ssee.auxiliary.sum() / expected.ssee.auxiliary.sum(), 1.0, 1e-9);
  EXPECT_NEAR(with.full.slowest_time_constant_s / expected.full.slowest_time_constant_s, 1.0, 1e-9);
  ASSERT_TRUE(with.missing[3] && with.missing[5]);
  for (const std::size_t lost : {3U, 5U}) {
    EXPECT_EQ(with.missing[lost]->V.rows(), 5);
    EXPECT_NEAR(with.missing[lost]->health_total_covariance.trace() / closed_form(model).ssee.health.sum(), 1.0, 1e-9)
        << "the other one is left";
  }
}

TEST(Redundancy, TripleProbesAndVeryDifferentNoise) {
  const LinearModel model = test::made_up_model(5, 7);
  LinearModel better = model;  // information 1 + 1/100^2 + 4
  better.sensor_noise_sigma(2) /= std::sqrt(1.0 + 1e-4 + 4.0);
  const Design with = closed_form(with_twin(with_twin(model, 2, 100.0), 2, 0.5)), expected = closed_form(better);
  expect_not_worse(with, closed_form(model), 5);
  EXPECT_NEAR(with.ssee.health.sum() / expected.ssee.health.sum(), 1.0, 1e-8);
}

TEST(Redundancy, DualChannelsEverywhere) {
  // More sensors than health parameters, and still fewer combinations than these.
  const LinearModel model = test::made_up_model(5, 7);
  LinearModel dual = model;
  for (std::size_t i = 0; i < 5; ++i) dual = with_twin(dual, i);
  LinearModel better = model;
  better.sensor_noise_sigma /= std::sqrt(2.0);
  const Design with = closed_form(dual);
  expect_not_worse(with, closed_form(model), 5);
  EXPECT_NEAR(with.ssee.health.sum() / closed_form(better).ssee.health.sum(), 1.0, 1e-9);
  for (const auto& subset : with.missing) EXPECT_EQ(subset.value().V.rows(), 5);
}

TEST(Redundancy, ACombinationOfOthersAddsNoTuner) {
  const LinearModel model = test::made_up_model(5, 7);
  Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(5);
  mean(2) = mean(3) = mean(4) = 1.0 / 3.0;
  expect_not_worse(closed_form(with_probe(model, "mean", mean, model.sensor_noise_sigma(3))), closed_form(model), 5);
}

TEST(Redundancy, NearlyEqualProbesAreOne) {
  // By less than what a linear model knows of its sensitivities; whatever the speed, the searched tuners too.
  const LinearModel model = test::made_up_model(5, 7);
  for (const double difference : {1e-6, 1e-4, 4e-3, 2e-2}) {
    for (const double qh : {1e-5, 1e-3, 1e-1}) {
      SCOPED_TRACE(std::to_string(difference) + " " + std::to_string(qh));
      LinearModel near = with_twin(model, 4);
      test::Random random(5);
      for (double& entry : near.M.row(5)) entry *= 1.0 + difference * random.normal();
      expect_not_worse(closed_form(near, qh), closed_form(model, qh), 5);
    }
  }
}

TEST(Redundancy, ASensorOfHardlyAnySignalDoesNotMakeItWorse) {
  LinearModel model = test::made_up_model(5, 7);
  const Design without = closed_form(model);
  model = with_twin(model, 4);
  for (double& entry : model.M.row(5)) entry = -entry;
  model.M(5, 0) *= 3.0;  // a direction of its own
  model.sensor_noise_sigma(5) *= 1e5;
  expect_not_worse(closed_form(model), without, 5);
}

TEST(Redundancy, SensorsAndDesignPriceTheSameSetAlike) {
  LinearModel model = test::made_up_model(5, 7);
  model = with_twin(model, 3);
  for (Eigen::MatrixXd* matrix : {&model.C, &model.M}) matrix->row(1).setZero();
  const SensorProblem problem = sensor_problem(model, 1e-3);
  const auto value = value_of(problem, problem.every());
  const Design design = closed_form(model);
  ASSERT_TRUE(value);
  EXPECT_EQ(value->tuners, design.full.V.rows());
  EXPECT_NEAR(value->error.health.sum(), design.ssee.health.sum(), 1e-9 * design.ssee.health.sum());
  EXPECT_NEAR(value->error.auxiliary.sum(), design.ssee.auxiliary.sum(), 1e-9 * design.ssee.auxiliary.sum());
}

TEST(BlindSensors, AreNamedAndNoDesignUsesThem) {
  LinearModel model = test::made_up_model(5, 7);
  for (Eigen::MatrixXd* matrix : {&model.C, &model.M}) {
    matrix->row(1).setZero();
    matrix->row(4).setZero();
  }
  const Design design = design_tuner(model, {});
  EXPECT_THAT(design.full.sensors, ::testing::ElementsAre(0, 2, 3));
  EXPECT_EQ(design.full.V.rows(), 3);
  EXPECT_THAT(design_as_json(design).at("blind_sensors"), ::testing::ElementsAre("N2", "y4"));
  EXPECT_TRUE(design.full.K.col(1).isZero(0.0));
  EXPECT_EQ(design.missing[4]->sensors, design.full.sensors) << "nothing is missing without it";
  EXPECT_THAT(design.missing[2]->sensors, ::testing::ElementsAre(0, 3));
  const std::string path = test::temporary_path("blind.json");
  design::write_design(design, path);
  const estimation::TunerFilter filter = design::make_filter(design::read_design(path));
  EXPECT_FALSE(filter.sensors()[1]);
  EXPECT_TRUE(filter.available(estimation::SensorSet::without(4)));
}

TEST(FaultSignatures, TellTwoEqualProbesApart) {
  // A step of one probe: its twin's signature explains only the part in which they agree.
  const Design design = closed_form(with_twin(test::made_up_model(5, 7), 3));
  const auto tables = monitor::fault_tables(design);
  const monitor::FaultSignatures& s = tables->full;
  const int m = s.sensors;
  Eigen::VectorXd x(m), y(m);
  double cross = 0.0;
  const Eigen::MatrixXd S = s.inverse_S.completeOrthogonalDecomposition().pseudoInverse();
  for (int a = 0; a < s.ages; ++a) {
    x = s.weight.middleCols(m * a, m).row(3).transpose();
    y = s.weight.middleCols(m * a, m).row(5).transpose();
    cross += x.dot(S * y);
  }
  const Eigen::Index last = s.ages - 1;
  const double similar = cross / std::sqrt(s.information(3, last) * s.information(5, last));
  EXPECT_LT(similar, -0.5) << "they disagree: a step up of one is one down of the other";
  EXPECT_GT(s.information(3, last) - cross * cross / s.information(5, last), 1.0)
      << "and which of the two it was is seen while the filter follows";
}

}  // namespace
}  // namespace ehm::tuner_design
