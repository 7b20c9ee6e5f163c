// SPDX-License-Identifier: Apache-2.0
// The search for V*: gradient, optima, certificate.

#include "tuner_design/search/tuner_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "deploy/runtime/numbers/index.h"
#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/design/choose_tuners.h"
#include "tuner_design/design/design_tuner.h"
#include "tuner_design/search/kalman_objective.h"
#include "tuner_design/search/map_objective.h"
#include "tuner_design/search/row_space.h"
#include "tuner_design/theory/kalman_error.h"
#include "tuner_design/theory/kalman_gain.h"
#include "tuner_design/theory/map_estimator.h"

namespace ehm::tuner_design {
namespace {

using design::DesignOptions;
using design::Tuning;

/// A random problem with `t` tuners: models differ in size, weights and, if asked for, in a linearisation error.
struct RandomProblem {
  explicit RandomProblem(std::uint64_t seed) : random(seed) {
    const int sensors = 3 + static_cast<int>(random.uniform(0.0, 4.0));
    const int health = sensors + 1 + static_cast<int>(random.uniform(0.0, 4.0));
    linear_model::LinearModel model = test::made_up_model(sensors, health);
    model.M += 0.3 * model.M.cwiseProduct(random.normal_matrix(sensors, health));
    for (double& sigma : model.health_sigma) sigma *= random.uniform(0.5, 2.0);
    if (seed % 2 == 0) {
      const Eigen::MatrixXd root = random.normal_matrix(sensors + 2, sensors + 2);
      const Eigen::VectorXd scale = (Eigen::VectorXd(sensors + 2) << model.sensor_noise_sigma, 5.0, 50.0).finished();
      model.linearisation_error = 0.1 * scale.asDiagonal() * root * root.transpose() * scale.asDiagonal();
    }
    point = prepare(model);
    all = all_sensors(model);
    weights.health = random.uniform(0.1, 2.0);
    weights.auxiliary = random.uniform(0.1, 2.0);
    weights.channel = {random.uniform(0.1, 2.0), random.uniform(0.1, 2.0)};
    problem = make_point_problem(point.model, point.steady, all, weights);
    qh = std::pow(10.0, random.uniform(-5.0, -2.0));
    V = random.normal_matrix(sensors - static_cast<int>(seed % 3 == 0), health);
  }
  test::Random random;
  PreparedPoint point;
  std::vector<int> all;
  design::ErrorWeights weights;
  PointProblem problem;
  double qh = 0.0;
  Eigen::MatrixXd V;  ///< no orthonormal rows

  /// J by the reference implementation: pseudoinverse, V Qh V^T, checked solvers.
  double kalman_reference(const Eigen::MatrixXd& tuners) const {
    design::SubsetDesign filter = kalman_gain(point.model, all, tuners, qh);
    add_error_theory(filter, point.model, point.steady);
    return problem.health_weight * filter.health_total_covariance.trace() +
           problem.auxiliary_weight.dot(filter.auxiliary_total_covariance.diagonal());
  }
  /// The same for the MAP estimator, without linearisation error.
  double map_reference(const Eigen::MatrixXd& tuners) const {
    const Eigen::MatrixXd R = problem.sensor_variance.asDiagonal();
    const Eigen::MatrixXd E = reduced_map_gain(problem.H, problem.health_covariance, R, tuners);
    const Eigen::MatrixXd error = snapshot_error_covariance(E, problem.H, problem.health_covariance, R);
    return problem.health_weight * error.trace() +
           problem.auxiliary_weight.dot((problem.Hz * error * problem.Hz.transpose()).diagonal());
  }
};

/// Central differences of fourth order over the entries of V.
template <typename Function>
Eigen::MatrixXd differences(const Function& function, const Eigen::MatrixXd& V) {
  constexpr double step = 1e-3;
  Eigen::MatrixXd result(V.rows(), V.cols());
  for (Eigen::Index i = 0; i < V.size(); ++i) {
    const auto at = [&](double move) {
      Eigen::MatrixXd moved = V;
      moved(i) += move;
      return function(moved);
    };
    result(i) = (8.0 * (at(step) - at(-step)) - (at(2.0 * step) - at(-2.0 * step))) / (12.0 * step);
  }
  return result;
}

TEST(KalmanObjective, ValueAndGradientAgreeWithTheReferenceOnRandomProblems) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const RandomProblem p(seed);
    const Eigen::MatrixXd V = row_space(p.V);
    Eigen::MatrixXd gradient;
    const auto value = kalman_objective(p.problem, V, p.qh, &gradient);
    ASSERT_TRUE(value.has_value()) << seed;
    EXPECT_NEAR(*value / p.kalman_reference(p.V), 1.0, 1e-9) << seed;
    const Eigen::MatrixXd expected = differences([&](const Eigen::MatrixXd& at) { return p.kalman_reference(at); }, V);
    // Where estimates are read off with least error V hardly matters: there the differences' own error of J counts.
    EXPECT_LT((gradient - expected).norm(), 1e-6 * expected.norm() + 2e-7 * *value) << seed;
    EXPECT_LT((gradient * V.transpose()).norm(), 1e-9 * gradient.norm()) << "along the rows of V nothing changes";
  }
}

TEST(MapObjective, ValueAndGradientAgreeWithTheReferenceOnRandomProblems) {
  for (std::uint64_t seed = 1; seed <= 12; seed += 2) {
    const RandomProblem p(seed);
    const Eigen::MatrixXd V = row_space(p.V);
    Eigen::MatrixXd gradient;
    const auto value = map_objective(p.problem, V, &gradient);
    ASSERT_TRUE(value.has_value()) << seed;
    EXPECT_NEAR(*value / p.map_reference(p.V), 1.0, 1e-9) << seed;
    const Eigen::MatrixXd expected = differences([&](const Eigen::MatrixXd& at) { return p.map_reference(at); }, V);
    EXPECT_LT((gradient - expected).norm(), 1e-6 * expected.norm()) << seed;
  }
}

TEST(RowSpaceChart, GradientFollowsTheCoordinatesFarFromTheCentre) {
  const RandomProblem p(5);
  const RowSpaceChart chart(row_space(p.V));
  test::Random random(3);
  const Eigen::MatrixXd x = random.normal_vector(chart.dimension());
  Eigen::MatrixXd T, V_gradient;
  const Eigen::MatrixXd V = chart.at(x, &T);
  ASSERT_TRUE(map_objective(p.problem, V, &V_gradient));
  const Eigen::MatrixXd expected =
      differences([&](const Eigen::MatrixXd& at) { return *map_objective(p.problem, chart.at(at)); }, x);
  EXPECT_LT((chart.gradient(V_gradient, T) - expected).norm(), 1e-6 * expected.norm());
}

TEST(PrincipalAngles, KnownPlanes) {
  const double angle = 0.3;
  Eigen::MatrixXd a = Eigen::MatrixXd::Identity(2, 4), b = a;
  b(1, 1) = std::cos(angle);
  b(1, 3) = std::sin(angle);
  EXPECT_NEAR(principal_angles(a, b)(0), angle, 1e-14);
  EXPECT_NEAR(principal_angles(a, b)(1), 0.0, 1e-14);
  b(1, 1) = std::cos(1e-9);
  b(1, 3) = std::sin(1e-9);
  EXPECT_NEAR(principal_angles(a, b)(0), 1e-9, 1e-15) << "arc cosines would lose this";
}

/// JT9D at cruise with the settings of theory.md, section 5.
class ReferenceSearch : public ::testing::Test {
 protected:
  void SetUp() override { model = test::jt9d_cruise(); }
  design::Design designed(double qh, Tuning tuning = Tuning::kalman) const {
    DesignOptions options;
    options.qh_percent2 = qh;
    options.tuning = tuning;
    return design_tuner(model, options, 2);
  }
  linear_model::LinearModel model;
};

TEST_F(ReferenceSearch, FiguresOfTheIssueAtTheReferenceQh) {
  const design::Design design = designed(1e-5);
  RecordProperty("ssee_health", std::to_string(design.ssee.health.sum()));
  // No worse than the closed form, whose error numpy and scipy give: reference_numbers_test.cpp.
  EXPECT_LE(design.ssee.health.sum(), 12.02);
  EXPECT_LE(design.ssee.auxiliary(0), 0.1797);
  EXPECT_LE(design.ssee.auxiliary(1), 31.17);
  EXPECT_LE(design.ssee.auxiliary(2), 1.858);
  EXPECT_LE(design.ssee.auxiliary(3), 1.201);
  EXPECT_TRUE(design.certificate.at_optimum) << design.certificate.verdict;
  ASSERT_EQ(design.certificate.starts.size(), 10U);
  for (const design::SearchStart& start : design.certificate.starts) {
    EXPECT_NEAR(start.last / design.certificate.objective, 1.0, 1e-6) << start.name;
    EXPECT_LT(start.angle_rad, 1e-3) << start.name;
    EXPECT_LT(start.gradient_norm, 1e-5) << start.name;
  }
  // At the limits J is 2; the closed form is within 1e-5 of the optimum here, and the search not above it.
  EXPECT_EQ(design.certificate.lower_bound, 2.0);
  EXPECT_LE(design.certificate.objective, design.certificate.closed_form_objective);
  EXPECT_NEAR(design.certificate.objective / design.certificate.closed_form_objective, 1.0, 1e-5);
}

TEST_F(ReferenceSearch, FastFilterGainsFromTheSearch) {
  const design::Design searched = designed(1e-2), closed = designed(1e-2, Tuning::closed_form);
  EXPECT_LT(searched.certificate.objective, closed.certificate.objective * (1.0 - 1e-4));
  EXPECT_TRUE(searched.certificate.at_optimum) << searched.certificate.verdict;
  EXPECT_FALSE(closed.certificate.at_optimum);
  EXPECT_THAT(closed.certificate.verdict, ::testing::StartsWith("not at an optimum"));
  // The Newton step that the certificate offers promises what the search found, to second order.
  const double gain = closed.certificate.objective - searched.certificate.objective;
  EXPECT_NEAR(closed.certificate.possible_gain / gain, 1.0, 0.1);
}

TEST_F(ReferenceSearch, MapSearchEndsAtTheFullOrderEstimator) {
  const design::Design design = designed(1e-3, Tuning::map);
  EXPECT_NEAR(design.reduced_map.health.sum() / design.full_map.health.sum(), 1.0, 1e-9);
  EXPECT_TRUE(design.reduced_map.auxiliary.isApprox(design.full_map.auxiliary, 1e-6));
  for (const design::SearchStart& start : design.certificate.starts)
    EXPECT_NEAR(start.last / design.certificate.objective, 1.0, 1e-6) << start.name;
}

TEST_F(ReferenceSearch, ABlindTunerIsNoTrap) {
  // MAP for health alone: random starts can end where one tuner is seen by no sensor, well above the optimum.
  const PreparedPoint point = prepare(model);
  SearchProblem problem;
  problem.estimator = Estimator::map;
  problem.points.push_back({make_point_problem(point.model, point.steady, all_sensors(model), {1.0, 0.0, {}}), 1.0});
  const SearchResult result = search_tuners(problem, {random_tuners(7, 10, 1, 1), 9, 2, 2});
  for (const design::SearchStart& start : result.starts)
    EXPECT_NEAR(start.last / result.starts.front().last, 1.0, 1e-6) << start.name;
}

TEST_F(ReferenceSearch, OneTunerMatrixForTheEnvelope) {
  std::vector<linear_model::LinearModel> models;
  for (const char* name : {"alt35000_MN0.8_PC100", "alt35000_MN0.8_PC80", "alt0_MN0_PC100"})
    if (const auto point = test::jt9d_point(name)) models.push_back(*point);
  if (models.empty()) GTEST_SKIP() << test::no_reference;
  DesignOptions options;
  options.qh_percent2 = 1e-5;
  const auto designs = design_envelope(models, {1.0, 1.0, 1.0}, options, 2);
  double sum = 0.0;
  for (const design::CertifiedPoint& point : designs.front().certificate.points)
    sum += point.health_ratio + point.auxiliary_ratio;
  RecordProperty("mean_ratio", std::to_string(sum / 6.0));
  std::cout << "mean of the six ratios SSEE/limit: " << sum / 6.0 << '\n';
  // 1.012 was asked of an engine in balance; the motion that process noise adds is 0.0003 of it.
  EXPECT_LE(sum / 6.0, 1.0124);
  EXPECT_TRUE(designs.front().certificate.at_optimum) << designs.front().certificate.verdict;
  for (const design::Design& design : designs) {
    EXPECT_EQ(design.full.V, designs.front().full.V);
    // The ratios of the certificate are those of the designs.
    const auto& point = design.certificate.points[as_size(&design - designs.data())];
    EXPECT_NEAR(design.ssee.health.sum() / design.bayes_limit.health.sum() / point.health_ratio, 1.0, 1e-9);
    EXPECT_NEAR(design.ssee.auxiliary.sum() / design.bayes_limit.auxiliary.sum() / point.auxiliary_ratio, 1.0, 1e-9);
  }
  EXPECT_LT(designs.front().certificate.objective, designs.front().certificate.closed_form_objective);
}

TEST_F(ReferenceSearch, OnlyAuxiliaryOutputsLeaveHealthWild) {
  // theory.md, section 6: a z-only objective leaves directions of h free.
  DesignOptions options;
  options.qh_percent2 = 1e-5;
  options.weights.health = 0.0;
  options.random_starts = 1;
  const design::Design design = design_tuner(model, options, 2);
  EXPECT_GT(design.ssee.health.sum(), designed(1e-5).ssee.health.sum());
  EXPECT_LT(design.certificate.objective, 1.01);
}

TEST(Search, DoesNotDependOnTheNumberOfThreads) {
  const DesignOptions options;
  const design::Design one = design_tuner(test::made_up_model(), options, 1);
  const design::Design five = design_tuner(test::made_up_model(), options, 5);
  EXPECT_EQ(one.full.V, five.full.V);
  EXPECT_EQ(one.full.K, five.full.K);
  EXPECT_EQ(one.certificate.possible_gain, five.certificate.possible_gain);
  DesignOptions other = options;
  other.seed = 2;
  EXPECT_NEAR(design_tuner(test::made_up_model(), other).certificate.objective / one.certificate.objective, 1.0, 1e-9);
}

TEST(Search, NothingToChooseWithEnoughSensors) {
  const design::Design design = design_tuner(test::made_up_model(6, 4), {});
  EXPECT_TRUE(design.certificate.at_optimum);
  EXPECT_THAT(design.certificate.verdict, ::testing::HasSubstr("nothing to choose"));
  EXPECT_TRUE(design.certificate.limit_is_prior) << "the limits are 0 and cannot divide";
  EXPECT_EQ(design.certificate.lower_bound, 0.0);
  EXPECT_TRUE(design.certificate.starts.empty());
}

TEST(Search, WithoutAuxiliaryOutputs) {
  linear_model::LinearModel model = test::made_up_model();
  model.auxiliary.clear();
  model.F.resize(0, 2);
  model.G.resize(0, 1);
  model.N.resize(0, 6);
  const design::Design design = design_tuner(model, {});
  EXPECT_TRUE(design.certificate.at_optimum) << design.certificate.verdict;
  EXPECT_EQ(design.certificate.lower_bound, 1.0);
}

TEST(Search, RefusesWrongWeights) {
  DesignOptions options;
  options.weights.health = 0.0;
  options.weights.auxiliary = 0.0;
  EXPECT_THROW(design_tuner(test::made_up_model(), options), std::invalid_argument);
  options.weights.auxiliary = -1.0;
  EXPECT_THROW(design_tuner(test::made_up_model(), options), std::invalid_argument);
  options.weights.auxiliary = 1.0;
  options.weights.channel = {1.0, 1.0, 1.0, 1.0, 1.0};
  EXPECT_THROW(design_tuner(test::made_up_model(), options), std::invalid_argument);
}

TEST(Envelope, RefusesModelsOfOtherChannels) {
  linear_model::LinearModel other = test::made_up_model();
  other.name = "other";
  other.sensors[3].unit = "degR";
  try {
    design_envelope({test::made_up_model(), other}, {1.0, 1.0}, {});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("model other has other sensors than made up"));
  }
}

}  // namespace
}  // namespace ehm::tuner_design
