// SPDX-License-Identifier: Apache-2.0
// The family study in short: who has a part in it, what no estimator of a constant may pass, and the same bytes on any
// number of threads. Its figures: `tuner_design study family`.

#include "tuner_design/family/family_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/engines/jt9d_engine.h"
#include "engine_sim/engines/shipped_engines.h"
#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/design/design_tuner.h"
#include "tuner_design/linearise/linearise.h"
#include "tuner_design/print/studies/family_text.h"

namespace ehm::tuner_design {
namespace {

const design::Design& cruise_design() {
  static const design::Design made = [] {
    LineariseOptions options;
    options.flight = {10668.0, 0.8, 0.0};
    options.demand = {engine_sim::DemandKind::t40_k, cruise_t40_k};
    return design_tuner(linearise(engine_sim::default_engine(), options).model, {});
  }();
  return made;
}

FamilyOptions in_short(unsigned threads) {
  FamilyOptions options;
  options.engine = engine_sim::default_engine();
  options.engines = 2;
  options.cases = {FamilyCase::rapid};
  options.estimator.particles = 2;
  options.threads = threads;
  return options;
}

std::string text(const FamilyStudy& study) {
  std::ostringstream out;
  print_family_study(study, out);
  return out.str() + family_study_as_csv(study) + family_study_as_json(study).dump();
}

TEST(FamilyStudy, EveryEstimatorHasItsPartAndTheBytesAreTheSameOnAnyNumberOfThreads) {
  const FamilyStudy study = run_family_study(cruise_design(), in_short(2));
  EXPECT_THAT(study.estimators,
              testing::IsSupersetOf({"tuner", "gauss_markov", "time_varying", "map", "wls", "rls", "onboard", "ekf",
                                     "iekf", "clipped_ekf", "ukf", "particle", "ekpf", "cekpf", "constrained"}));
  EXPECT_THAT(study.left_out, testing::ElementsAre("scheduled"));  // the design has no schedule
  ASSERT_EQ(study.cases.size(), 1u);
  for (const FamilyCaseResult& c : study.cases) {
    EXPECT_EQ(c.flown, 2u);
    // at the point whoever flies the engine has an answer to every sample
    for (const char* name : {"onboard", "ekf", "iekf", "ukf"}) {
      const auto at = std::find(study.estimators.begin(), study.estimators.end(), name) - study.estimators.begin();
      EXPECT_EQ(c.scores[as_size(at)]->held, 1.0) << name;
    }
  }
  // 4 (10 - 7) percent^2, and what the noise of 40 s leaves
  EXPECT_NEAR(study.limit, 12.0, 0.2);
  const auto place = [&](const char* name) {
    return as_size(std::find(study.estimators.begin(), study.estimators.end(), name) - study.estimators.begin());
  };
  // a constant is what the time-varying filter never follows, and the tuner filter does within its time constant
  const FamilyCaseResult& rapid = study.cases.front();
  EXPECT_FALSE(rapid.scores[place("time_varying")]->answer_s.has_value());
  EXPECT_EQ(text(run_family_study(cruise_design(), in_short(1))), text(study));
}

TEST(FamilyStudy, InShortFlightsWhoIsToldOfWearFollowsItAndAConstantDoesNot) {
  FamilyOptions options = in_short(2);
  options.cases = {FamilyCase::batches};
  const FamilyStudy study = run_family_study(cruise_design(), options);
  const FamilyCaseResult& c = study.cases.front();
  ASSERT_EQ(c.flown, 2u);
  const auto score = [&](const char* name) {
    const auto at = std::find(study.estimators.begin(), study.estimators.end(), name) - study.estimators.begin();
    return *c.scores[as_size(at)];
  };
  EXPECT_EQ(score("ekf").held, 1.0);
  EXPECT_EQ(score("tuner").held, 1.0);
  // 1500 samples of wear that moves by percents: what takes health for constant lags behind, and does not know
  EXPECT_LT(score("time_varying").coverage, score("ekf").coverage);
}

TEST(FamilyStudy, OnlyWhoIsAskedForFliesAndTheLeastCoveredParameterIsNoBetterThanAll) {
  FamilyOptions options = in_short(2);
  options.cases = {FamilyCase::constant};
  options.estimators = {"ekf", "tuner"};
  const FamilyStudy study = run_family_study(cruise_design(), options);
  EXPECT_THAT(study.estimators, testing::ElementsAre("tuner", "ekf"));  // as in the table
  for (const auto& score : study.cases.front().scores) {
    ASSERT_TRUE(score);
    EXPECT_LE(score->least_coverage, score->coverage);
  }
}

TEST(FamilyStudy, AnotherEnginesDesignIsRefused) {
  FamilyOptions options = in_short(1);
  options.engine = engine_sim::named_engine("high_bypass");
  EXPECT_THROW(run_family_study(cruise_design(), options), std::invalid_argument);
}

}  // namespace
}  // namespace ehm::tuner_design
