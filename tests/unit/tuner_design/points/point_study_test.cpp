// SPDX-License-Identifier: Apache-2.0
// The study of single points, reduced: with what the model misses in the estimate the nonlinear engine is estimated as
// well as it is claimed; without, it is not. Whole: `tuner_design study points`.

#include "tuner_design/points/point_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "engine_sim/engines/jt9d_engine.h"
#include "tuner_design/print/studies/point_study_text.h"

namespace ehm::tuner_design {
namespace {

PointStudy studied(unsigned threads) {
  PointStudyOptions options;
  options.engine = engine_sim::default_engine();
  options.engines = 40;
  options.fleet = 400;
  options.seed = 71;
  options.threads = threads;
  return run_point_study(options);
}

TEST(PointStudy, WhatTheModelMissesCountsAndIsClaimed) {
  const PointStudy study = studied(2);
  ASSERT_EQ(study.points.size(), studied_points().size());
  for (const PointResult& point : study.points) {
    SCOPED_TRACE(point.name);
    // of 40 engines: three standard errors, some 3 percent^2
    EXPECT_NEAR(point.with.flown, point.with.claimed, 3.0 * point.with.standard_error);
    EXPECT_LT(point.with.claimed, asked_ssee);
    EXPECT_GE(point.with.claimed, point.limit);
    EXPECT_LT(point.with.claimed, 1.05 * point.limit);
    EXPECT_GT(point.with.worst_coverage, point.without.worst_coverage);
  }
  EXPECT_LT(study.points[cruise_point].without.worst_coverage, 0.5);
  ASSERT_EQ(study.shared.size(), 4u);
  for (std::size_t i = 1; i < study.shared.size(); ++i) {
    EXPECT_LT(study.shared[i].mean, study.shared[i - 1].mean);
    EXPECT_LE(study.shared[i].mean, study.shared[i].worst);
  }
  std::ostringstream text;
  print_point_study(study, text);
  EXPECT_THAT(text.str(), testing::HasSubstr("one V* for all points"));
  EXPECT_EQ(point_study_as_json(study).dump(), point_study_as_json(studied(1)).dump());
}

}  // namespace
}  // namespace ehm::tuner_design
