// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/design/response_time.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/design/design_tuner.h"

namespace ehm::tuner_design {
namespace {

TEST(ResponseTime, FindsQhAndTunersTogether) {
  const linear_model::LinearModel model = test::made_up_model();
  design::DesignOptions options;
  for (const double wanted_s : {0.5, 2.0, 10.0}) {
    options.qh_percent2 = qh_for_time_constant({model}, {1.0}, options, wanted_s);
    const design::Design design = design_tuner(model, options);
    EXPECT_NEAR(design.full.slowest_time_constant_s / wanted_s, 1.0, 1e-6);
    EXPECT_TRUE(design.certificate.at_optimum) << design.certificate.verdict;
  }
}

TEST(ResponseTime, SaysWhatIsInReach) {
  try {
    qh_for_time_constant({test::made_up_model()}, {1.0}, {}, 1e-4);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("the slowest time constant cannot be 0.0001 s; in reach are "));
  }
}

TEST(ResponseSweep, FasterIsNoisierAndTheSearchIsNeverWorse) {
  const design::Design design = design_tuner(test::made_up_model(), {});
  const auto points = response_sweep(design, logarithmic_steps(1e-6, 1e-1, 6), 2);
  ASSERT_EQ(points.size(), 6U);
  for (std::size_t i = 1; i < points.size(); ++i) {
    EXPECT_LT(points[i].time_constant_s, points[i - 1].time_constant_s);
    EXPECT_GT(points[i].health_noise, points[i - 1].health_noise);
    EXPECT_GE(points[i].objective, points[i - 1].objective);
    EXPECT_GE(points[i].health(), design.bayes_limit.health.sum());
  }
  // The point at the design's own Qh is the design.
  EXPECT_NEAR(points[3].qh_percent2, 1e-3, 1e-15);
  EXPECT_NEAR(points[3].health() / design.ssee.health.sum(), 1.0, 1e-6);
  EXPECT_NEAR(points[3].auxiliary() / design.ssee.auxiliary.sum(), 1.0, 1e-6);
}

}  // namespace
}  // namespace ehm::tuner_design
