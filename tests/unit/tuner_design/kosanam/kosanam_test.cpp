// SPDX-License-Identifier: Apache-2.0
// The tables of Kosanam's thesis on the MAPSS model, small: filters that know their model state their error, the
// constraint gains against wear and the ratchet loses, the closed form wins where noise is wrong; the same on any
// number of threads; what cannot be flown is named.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>

#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/kosanam/constrained_tables.h"
#include "tuner_design/kosanam/gain_search.h"
#include "tuner_design/kosanam/mapss_model.h"
#include "tuner_design/kosanam/robust_tables.h"
#include "tuner_design/print/studies/kosanam_text.h"

namespace ehm::tuner_design {
namespace {

// The file's own R and Q, and eigenvalues: spools .906 +- .017i, metal .992.
TEST(MapssModel, IsTheReferenceFile) {
  const linear_model::LinearModel ours = mapss_model();
  EXPECT_NEAR(ours.A.trace(), 0.90291934 + 0.90880572 + 0.99239568, 1e-7);
  const auto reference = test::mapss();
  if (!reference) GTEST_SKIP() << test::no_reference;
  const auto same = [](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    return (a - b).cwiseAbs().maxCoeff() <= 1e-9 * b.cwiseAbs().maxCoeff();
  };
  EXPECT_TRUE(same(ours.A, reference->A) && same(ours.B, reference->B) && same(ours.L, reference->L));
  EXPECT_TRUE(same(ours.C, reference->C) && same(ours.D, reference->D) && same(ours.M, reference->M));
  EXPECT_TRUE(same(ours.process_noise, reference->process_noise));
  EXPECT_TRUE(same(ours.sensor_noise_sigma, reference->sensor_noise_sigma));
}

// The steady covariance is the fixed point of the recursion, and the time-varying one reaches it.
TEST(BatchFilter, TheTimeVaryingGainGoesToTheSteadyOne) {
  const BatchProblem problem = batch_problem(mapss_model(), 25e-6);
  const SteadyFilter steady = steady_filter(problem);
  TimeVaryingGain varying(problem);
  for (int k = 0; k < 30000; ++k) varying.step();
  EXPECT_LT((varying.now().K - steady.K).norm(), 1e-6 * steady.K.norm());
  EXPECT_LT((varying.now().P - steady.P).norm(), 1e-6 * steady.P.norm());
}

ConstrainedTables small_tables(unsigned threads, int flights = 300) {
  ConstrainedTablesOptions options;
  options.batch.runs = 4;
  options.batch.flights = flights;
  options.batch.threads = threads;
  options.sweep = {1.0, 3.0};
  return constrained_tables(mapss_model(), options);
}

TEST(ConstrainedTables, TheConstraintGainsAndTheRatchetLoses) {
  using namespace constrained_case;
  const ConstrainedTables tables = small_tables(2);
  EXPECT_LT(tables.ratio(identity), 0.95);
  EXPECT_LT(tables.ratio(projection_behind), 1.0);
  EXPECT_LT(tables.ratio(truncation_3_behind), 0.95);
  EXPECT_GT(tables.ratio(projection_fed_back), 3.0);
  EXPECT_GT(tables.ratio(truncation), 3.0);  // its mean lies always before its bound
  const BatchResult& result = tables.table();
  EXPECT_GT(result.filters[projection_fed_back].bias.mean(), result.filters[projection].bias.mean());
  EXPECT_GT(result.filters[projection].bias.mean(), result.filters[kalman].bias.mean());
  EXPECT_NEAR(tables.ratio(time_varying), 1.0, 0.1);
  // no constraint makes the sigma of a filter honest that lags behind the wear, and it costs little
  EXPECT_NEAR(result.filters[truncation_3_behind].coverage.mean(), result.filters[kalman].coverage.mean(), 0.03);
  std::ostringstream text;
  print_constrained_tables(tables, text);
  EXPECT_THAT(text.str(), testing::HasSubstr("Table 5.1"));
  EXPECT_EQ(constrained_tables_as_json(tables)["sweep"].size(), 2u);
}

// Asked: constrained over unconstrained as published, 0.80, and 0.93 to 0.97 of the truth within the truncation's
// sigma. Measured: of the thesis' way 0.91 with the wear table, where LPT flow moves by three sigma in a life, 0.85
// with 3 % each; of the truncation with its bound two sigma behind 0.83, its sigma covers 0.953.
TEST(ConstrainedTables, TheFiguresThatWereAsked) {
  using namespace constrained_case;
  ConstrainedTablesOptions options;
  options.batch.threads = 2;
  options.sweep = {3.0};
  const ConstrainedTables tables = constrained_tables(mapss_model(), options);
  EXPECT_NEAR(tables.ratio(identity), 0.91, 0.01);
  EXPECT_NEAR(tables.ratio(truncation_2_behind), 0.83, 0.01);
  const double coverage = tables.table().filters[truncation_2_behind].coverage.mean();
  EXPECT_GE(coverage, 0.93);
  EXPECT_LE(coverage, 0.97);
  options.batch.runs = 10;
  options.batch.equal_wear_percent = 3.0;
  EXPECT_NEAR(constrained_tables(mapss_model(), options).ratio(identity), 0.84, 0.02);
}

TEST(ConstrainedTables, AreTheSameOnAnyNumberOfThreads) {
  EXPECT_EQ(constrained_tables_csv(small_tables(1, 30)), constrained_tables_csv(small_tables(3, 30)));
}

TEST(ConstrainedTables, FewerSensorsThanHealthParametersAreRefused) {
  try {
    constrained_tables(test::jt9d_cruise(), {});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("has 7 sensors and 10 health parameters; this study needs"));
  }
}

TEST(RobustTables, TheClosedFormWinsWhereTheNoiseIsWrong) {
  RobustTablesOptions options;
  options.batch.runs = 10;
  options.batch.threads = 2;
  options.sweep = {100.0};
  options.noise_factors = {1.0, 9.0};
  const RobustTables tables = robust_tables(mapss_model(), options);
  EXPECT_GT(tables.mu, 1.0);
  EXPECT_LT(tables.robust_objective, 0.4 * tables.standard_objective);
  const BatchResult &wrong = tables.at(9.0), &nominal = tables.at(1.0);
  EXPECT_LT(wrong.mean_rms(robust_case::robust), 0.85 * wrong.mean_rms(robust_case::standard));
  EXPECT_LT(wrong.mean_rms(robust_case::mixed), wrong.mean_rms(robust_case::standard));
  EXPECT_GT(nominal.mean_rms(robust_case::robust), nominal.mean_rms(robust_case::standard));
  std::ostringstream text;
  print_robust_tables(tables, text);
  EXPECT_THAT(text.str(), testing::AllOf(testing::HasSubstr("Table 5.2"), testing::HasSubstr("Table 5.3")));
}

TEST(GainSearch, HelpsWhereTheModelIsWrongAndFindsTheKalmanGainWhereOnlyNoiseIs) {
  GainSearchOptions options;
  options.training_runs = 20;
  options.test_runs = 100;
  options.evaluations = 400;
  const GainSearch study = search_gains(options);
  ASSERT_EQ(study.rows.size(), 2u);
  EXPECT_GT(study.rows[1].saved(2), 0.4);
  EXPECT_NEAR(study.rows[0].saved(2), 0.0, 0.1);
  EXPECT_EQ(gain_search_csv(study), gain_search_csv(search_gains(options)));
}

}  // namespace
}  // namespace ehm::tuner_design
