// SPDX-License-Identifier: Apache-2.0
// The table of baselines, the best subset, and the filters that need no tuners, on the JT9D reference and a made-up
// engine.

#include "tuner_design/baselines/baselines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/baselines/best_subset.h"
#include "tuner_design/design/design_tuner.h"
#include "tuner_design/design/tuner_baselines.h"
#include "tuner_design/print/baseline_text.h"

namespace ehm::tuner_design {
namespace {

using ::testing::HasSubstr;

const Baseline& row(const std::vector<Baseline>& table, const std::string& name) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const Baseline& b) { return b.name == name; });
  if (found == table.end()) throw std::runtime_error("no baseline " + name);
  return *found;
}

bool has(const std::vector<Baseline>& table, const std::string& name) {
  return std::any_of(table.begin(), table.end(), [&](const Baseline& b) { return b.name == name; });
}

/// The closed form at the reference Qh of theory.md, section 5.
class JetBaselines : public ::testing::Test {
 protected:
  void SetUp() override {
    design::DesignOptions options;
    options.qh_percent2 = 1e-5;
    options.tuning = design::Tuning::closed_form;
    design = design_tuner(test::jt9d_cruise(), options);
  }
  /// T40 and T50 in degR^2, as theory.md, section 5 gives z.
  static double rankine(const design::ErrorByChannel& e) {
    return 3.24 * (e.auxiliary(0) + e.auxiliary(1)) + e.auxiliary(2) + e.auxiliary(3);
  }
  design::Design design;
};

TEST_F(JetBaselines, AreTheFiguresOfTheory) {
  const std::vector<Baseline> table = baselines(design, {});
  EXPECT_NEAR(row(table, "closed_form").error.health.sum(), 12.016144, 1e-6);
  EXPECT_TRUE(row(table, "closed_form").error.health.isApprox(row(table, "design").error.health, 1e-12));
  EXPECT_NEAR(rankine(row(table, "closed_form").error), 104.622539, 1e-4);
  EXPECT_NEAR(row(table, "published_subset").error.health.sum(), 106.995882, 1e-5);
  EXPECT_NEAR(rankine(row(table, "published_subset").error), 274.590473, 1e-4);
  EXPECT_NEAR(row(table, "full_map").error.health.sum(), 19.717, 1e-3);
  EXPECT_NEAR(row(table, "bayes_limit").error.health.sum(), 12.000, 1e-3);
  EXPECT_NEAR(rankine(row(table, "bayes_limit").error), 103.695, 1e-2);
}

TEST_F(JetBaselines, FullOrderFilters) {
  const std::vector<Baseline> table = baselines(design, {});
  // 12.016127 and 19.8586 s: numpy and scipy on the same matrices (solve_discrete_are, solve_discrete_lyapunov), with
  // 1 - rho^2 = 1e-5 / 4.
  const Baseline& markov = row(table, "gauss_markov");
  EXPECT_NEAR(markov.error.health.sum(), 12.016127, 1e-5);
  EXPECT_NEAR(markov.slowest_time_constant_s.value(), 19.8586, 1e-3);
  EXPECT_THAT(markov.description, HasSubstr("forgets in 12000 s"));
  const Baseline& varying = row(table, "time_varying");
  EXPECT_THAT(varying.description, HasSubstr("after 2000 samples, 30 s"));
  // 12.013704 and 104.421527: the Riccati recursion in numpy over 2000 samples, from a moving engine of the fleet.
  EXPECT_NEAR(varying.error.health.sum(), 12.013704, 1e-5);
  EXPECT_NEAR(rankine(varying.error), 104.421527, 1e-4);
  // Without process noise 2000 samples are one with R / 2000: full MAP, which is closed.
  design::Design still = design, quiet = design;
  still.model.process_noise.setZero();
  quiet.model.sensor_noise_sigma /= std::sqrt(2000.0);
  const design::Design averaged = design_tuner(quiet.model, design.options);
  EXPECT_TRUE(row(baselines(still, {}), "time_varying").error.health.isApprox(averaged.full_map.health, 1e-7));
  EXPECT_LT(varying.error.health.sum(), row(table, "closed_form").error.health.sum());
  EXPECT_GT(varying.error.health.sum(), row(table, "bayes_limit").error.health.sum());
}

TEST_F(JetBaselines, NoSubsetBeatsTheBestOne) {
  const std::vector<Baseline> table = baselines(design, {});
  const Baseline& best = row(table, "best_subset");
  EXPECT_THAT(best.description, HasSubstr("all 120 subsets"));
  const double h = design.bayes_limit.health.sum(), z = design.bayes_limit.auxiliary.sum();
  const auto merit = [&](const Baseline& b) { return b.error.health.sum() / h + b.error.auxiliary.sum() / z; };
  EXPECT_LT(merit(best), merit(row(table, "published_subset")));
  EXPECT_GT(merit(best), merit(row(table, "closed_form")));
  BaselineOptions threads;
  threads.threads = 4;
  EXPECT_EQ(row(baselines(design, threads), "best_subset").description, best.description);
}

class MadeUpBaselines : public ::testing::Test {
 protected:
  const design::Design design = design_tuner(test::made_up_model(4, 6), {});
};

TEST_F(MadeUpBaselines, BestSubsetIsTheLeastOfAllNamedOnes) {
  const std::vector<Baseline> table = baselines(design, {});
  EXPECT_FALSE(has(table, "published_subset")) << "the model has no health parameters of these names";
  const double h = design.bayes_limit.health.sum(), z = design.bayes_limit.auxiliary.sum();
  const auto merit = [&](const Baseline& b) { return b.error.health.sum() / h + b.error.auxiliary.sum() / z; };
  double least = std::numeric_limits<double>::infinity();
  for (const std::vector<int>& subset : all_subsets(6, 4)) {
    BaselineOptions options;
    for (const int i : subset) options.named_subset.push_back("h" + std::to_string(i));
    least = std::min(least, merit(row(baselines(design, options), "named_subset")));
  }
  EXPECT_NEAR(merit(row(table, "best_subset")) / least, 1.0, 1e-12);
}

TEST_F(MadeUpBaselines, LinearisationErrorIsLeftOut) {
  linear_model::LinearModel model = design.model;
  model.linearisation_error = 1e-6 * Eigen::MatrixXd::Identity(6, 6);
  design::Design with = design;  // the same tuners
  with.model = model;
  const std::vector<Baseline> a = baselines(design, {}), b = baselines(with, {});
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].error.health, b[i].error.health) << a[i].name;
    EXPECT_EQ(a[i].error.auxiliary, b[i].error.auxiliary) << a[i].name;
  }
}

TEST_F(MadeUpBaselines, MistakesAreRefused) {
  BaselineOptions options;
  options.named_subset = {"h0", "h0"};
  EXPECT_THROW(baselines(design, options), std::invalid_argument);
  options.named_subset = {"h0", "wing"};
  EXPECT_THROW(baselines(design, options), std::invalid_argument);
  options.named_subset = {"h0", "h1", "h2", "h3", "h4"};  // five tuners, four sensors: never to be told apart
  EXPECT_THROW(baselines(design, options), std::runtime_error);
  options.named_subset.clear();
  options.run_s = 0.001;
  EXPECT_THROW(baselines(design, options), std::invalid_argument);
  EXPECT_THROW(all_subsets(6, 7), std::invalid_argument);
  EXPECT_THROW(all_subsets(6, 0), std::invalid_argument);
}

TEST(Baselines, WithEnoughSensorsNothingIsReduced) {
  const design::Design design = design_tuner(test::made_up_model(8, 5), {});
  EXPECT_EQ(subsets_to_try(design), 0U);
  const std::vector<Baseline> table = baselines(design, {});
  EXPECT_FALSE(has(table, "best_subset"));
  EXPECT_FALSE(has(table, "svd"));
  EXPECT_TRUE(baselines_as_json(design, table).back().at("over_limit_health").is_null()) << "the limit is zero";
}

TEST(Baselines, SubsetsAreCountedAndOrdered) {
  const std::vector<std::vector<int>> expected{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
  EXPECT_EQ(all_subsets(4, 2), expected);
  EXPECT_EQ(all_subsets(16, 8).size(), 12870U);  // 16! / (8! 8!)
  EXPECT_EQ(subsets_to_try(design_tuner(test::made_up_model(4, 6), {})), 15U);
}

}  // namespace
}  // namespace ehm::tuner_design
