// SPDX-License-Identifier: Apache-2.0
// Sensor selection against brute force, bounds against the Bayes limit, and what the front must be.

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <numeric>

#include "deploy/runtime/numbers/index.h"
#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/design/design_tuner.h"
#include "tuner_design/sensors/sensor_front.h"
#include "tuner_design/sensors/subset_bounds.h"
#include "tuner_design/theory/bayes_limit.h"

namespace ehm::tuner_design {
namespace {

/// Random engine: noise and influence of each sensor differ.
SensorProblem random_problem(std::uint64_t seed, int sensors, int health) {
  test::Random random(seed);
  linear_model::LinearModel model = test::made_up_model(sensors, health);
  for (Eigen::Index i = 0; i < model.sensor_noise_sigma.size(); ++i) {
    model.sensor_noise_sigma(i) *= random.uniform(0.1, 3.0);
    if (i >= 2) model.M.row(i) *= random.uniform(0.2, 2.0);
  }
  for (double& sigma : model.health_sigma) sigma *= random.uniform(0.5, 2.0);
  return sensor_problem(model, 1e-3);
}

std::vector<double> random_costs(std::uint64_t seed, std::size_t sensors) {
  test::Random random(seed + 100);
  std::vector<double> cost(sensors);
  for (double& c : cost) c = random.uniform(0.5, 3.0);
  return cost;
}

std::vector<int> indices(CandidateSet set) {
  std::vector<int> result;
  for (int i = 0; i < max_candidates; ++i) {
    if ((set >> i & 1U) != 0) result.push_back(i);
  }
  return result;
}

/// Points that no other set beats in cost and J, by looking at every set.
std::vector<std::pair<double, double>> brute_force(const SensorProblem& problem, const SensorChoice& choice) {
  std::vector<std::pair<double, double>> all;
  for (CandidateSet set = 1; set <= problem.every(); ++set) {
    const double cost = cost_of(set, choice.cost);
    const auto value = value_of(problem, set);
    if (value && (set & choice.keep) == choice.keep && cost <= choice.budget &&
        std::popcount(set) <= choice.max_sensors)
      all.emplace_back(cost, value->merit);
  }
  std::sort(all.begin(), all.end());
  std::vector<std::pair<double, double>> front;
  for (const auto& point : all) {
    if (front.empty() || point.second < front.back().second) front.push_back(point);
  }
  return front;
}

void expect_front(const SensorProblem& problem, const SensorChoice& choice) {
  const SensorFront front = sensor_front(problem, choice, 2);
  const auto expected = brute_force(problem, choice);
  ASSERT_EQ(front.points.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(front.points[i].cost, expected[i].first);
    EXPECT_EQ(front.points[i].value.merit, expected[i].second);
    EXPECT_EQ(cost_of(front.points[i].sensors, choice.cost), front.points[i].cost);
    EXPECT_EQ(value_of(problem, front.points[i].sensors)->merit, front.points[i].value.merit);
    if (i == 0) continue;
    EXPECT_GT(front.points[i].cost, front.points[i - 1].cost);
    EXPECT_LT(front.points[i].value.merit, front.points[i - 1].value.merit);
  }
}

TEST(SensorFront, IsThatOfBruteForce) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE(seed);
    const SensorProblem problem = random_problem(seed, 8, 10);
    expect_front(problem, {.cost = random_costs(seed, 8)});
    expect_front(problem, {.cost = std::vector<double>(8, 1.0)});
  }
}

TEST(SensorFront, IsThatOfBruteForceWithMoreSensorsThanHealth) {
  expect_front(random_problem(9, 8, 4), {.cost = random_costs(9, 8)});
}

TEST(SensorFront, KeepsBudgetNumberAndWhatIsToBeKept) {
  const SensorProblem problem = random_problem(5, 8, 10);
  const SensorChoice choice{.cost = random_costs(5, 8), .keep = 0b10000100, .budget = 9.0, .max_sensors = 5};
  expect_front(problem, choice);
  for (const FrontPoint& point : sensor_front(problem, choice, 1).points) {
    EXPECT_EQ(point.sensors & choice.keep, choice.keep);
    EXPECT_LE(point.cost, 9.0);
    EXPECT_LE(std::popcount(point.sensors), 5);
  }
}

TEST(SensorFront, TheBoundSavesFiltersAndThreadsChangeNothing) {
  const SensorProblem problem = random_problem(3, 11, 12);
  const SensorChoice choice{.cost = random_costs(3, 11)};
  const SensorFront one = sensor_front(problem, choice, 1), four = sensor_front(problem, choice, 4);
  EXPECT_EQ(one.sets, (1U << 11U) - 1U);
  EXPECT_LT(one.filters, one.sets / 4) << "of 2047 sets";
  EXPECT_EQ(one.filters, four.filters);
  ASSERT_EQ(one.points.size(), four.points.size());
  for (std::size_t i = 0; i < one.points.size(); ++i) {
    EXPECT_EQ(one.points[i].sensors, four.points[i].sensors);
    EXPECT_EQ(one.points[i].value.merit, four.points[i].value.merit);
  }
}

TEST(SensorFront, AUselessSensorIsNeverBought) {
  linear_model::LinearModel model = test::made_up_model(6, 8);
  for (Eigen::MatrixXd* matrix : {&model.C, &model.M}) matrix->row(5).setZero();
  const SensorProblem problem = sensor_problem(model, 1e-3);
  for (const FrontPoint& point : sensor_front(problem, {.cost = std::vector<double>(6, 1.0)}, 1).points)
    EXPECT_EQ(point.sensors >> 5U & 1U, 0U);
  EXPECT_FALSE(value_of(problem, 0b100000)) << "alone it tells nothing";
  EXPECT_FALSE(value_of(problem, 0));
}

TEST(SubsetBounds, AreTheBayesLimitAndBoundEverySubset) {
  for (const int health : {5, 10}) {
    SCOPED_TRACE(health);
    const SensorProblem problem = random_problem(1, 8, health);
    const std::vector<double> bounds = subset_bounds(problem);
    const Eigen::MatrixXd Ph = problem.model.health_sigma.cwiseAbs2().asDiagonal();
    ASSERT_EQ(bounds.size(), 256U);
    EXPECT_EQ(bounds[0], fleet_merit(problem));
    for (CandidateSet set = 1; set <= problem.every(); ++set) {
      const Eigen::MatrixXd U = bayes_limit_factor(problem.steady.H(indices(set), Eigen::all), Ph);
      const double limit = problem.merit({U.rowwise().squaredNorm(), (problem.steady.Hz * U).rowwise().squaredNorm()});
      EXPECT_NEAR(bounds[set], limit, 1e-9 * bounds[0]) << set;
      const auto value = value_of(problem, set);
      EXPECT_TRUE(!value || value->merit > bounds[set] - 1e-9 * bounds[0]) << set;
      for (int i = 0; i < 8; ++i) EXPECT_LE(bounds[set], bounds[set & ~(1U << i)] + 1e-9 * bounds[0]);
    }
  }
}

TEST(SensorSetValue, IsWhatADesignOnTheseSensorsPublishes) {
  linear_model::LinearModel model = test::made_up_model(5, 7);
  const SensorProblem problem = sensor_problem(model, 1e-3);
  const std::vector<int> some{0, 2, 3};
  linear_model::LinearModel part = model;
  part.sensors.clear();
  for (const int i : some) part.sensors.push_back(model.sensors[as_size(i)]);
  part.sensor_noise_sigma = Eigen::VectorXd(model.sensor_noise_sigma(some));
  part.C = Eigen::MatrixXd(model.C(some, Eigen::all));
  part.D = Eigen::MatrixXd(model.D(some, Eigen::all));
  part.M = Eigen::MatrixXd(model.M(some, Eigen::all));
  design::DesignOptions options;
  options.tuning = design::Tuning::closed_form;
  const design::Design design = design_tuner(part, options);
  const auto value = value_of(problem, 0b01101);
  ASSERT_TRUE(value);
  EXPECT_EQ(value->tuners, 3);
  EXPECT_TRUE(value->error.health.isApprox(design.full.health_total_covariance.diagonal(), 1e-9));
  EXPECT_TRUE(value->error.auxiliary.isApprox(design.full.auxiliary_total_covariance.diagonal(), 1e-9));
}

TEST(SensorSetValue, WithoutEachLeavesOneOut) {
  const SensorProblem problem = random_problem(2, 5, 7);
  const auto without = without_each(problem);
  ASSERT_EQ(without.size(), 5U);
  EXPECT_EQ(without[1]->merit, value_of(problem, 0b11101)->merit);
}

TEST(SensorProblemTest, RefusesMoreThanTwentyCandidates) {
  EXPECT_NO_THROW(random_problem(0, 20, 10));
  EXPECT_THROW(random_problem(0, 21, 10), std::invalid_argument);
}

}  // namespace
}  // namespace ehm::tuner_design
