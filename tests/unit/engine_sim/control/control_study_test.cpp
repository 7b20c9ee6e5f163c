// SPDX-License-Identifier: Apache-2.0
// Random demand sequences stay inside the limits and never stall LPC or HPC (issue 3). Prints the worst cases.

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "tests/unit/engine_sim/control/demand_study.h"

namespace {

using namespace ehm::test;

constexpr double duration_s = 25.0;

/// Overshoot that the control may have, percent: half a percent of a speed and one of T48 and Ps30.
constexpr std::array<double, figure_count> most{0.0, 0.0, 0.5, 0.5, 1.0, 1.0, 0.5};

std::uint64_t sequences() {
  const char* const given = std::getenv("EHM_CONTROL_SEQUENCES");
  return given ? std::strtoull(given, nullptr, 10) : 100;
}

TEST(ControlStudy, RandomDemandsStayInsideTheLimitsAndNeverStall) {
  const std::uint64_t count = sequences();
  ASSERT_GE(count, 1u) << "EHM_CONTROL_SEQUENCES is no number from 1";
  const StudyResult r = fly_sequences(1, count, duration_s);
  std::printf("%llu sequences of %.0f s\n%s", static_cast<unsigned long long>(count), duration_s, table(r).c_str());
  EXPECT_TRUE(r.failures.empty());
  EXPECT_GT(r.worst[lpc_margin].value, 0.0);
  EXPECT_GT(r.worst[hpc_margin].value, 0.0);
  for (const Figure over : {n1_over, n2_over, t48_over, ps_30_over, idle_under}) {
    EXPECT_LT(r.worst[over].value, most[over]) << figure_names[over];
  }
}

// Metal that is colder or hotter than the gas costs stall margin. The schedules were set without it: the LPC keeps a
// margin, the HPC of the worst worn engine may pass the surge line by less than one percent (not of the issue's
// limits).
TEST(ControlStudy, HeatSoakCostsMarginAndTheLpcStillDoesNotStall) {
  const StudyResult r = fly_sequences(1, sequences(), duration_s, ehm::engine_sim::HeatSoak::with);
  std::printf("with heat soak\n%s", table(r).c_str());
  EXPECT_TRUE(r.failures.empty());
  EXPECT_GT(r.worst[lpc_margin].value, 0.0);
  EXPECT_GT(r.worst[hpc_margin].value, -1.0);
}

TEST(ControlStudy, IsTheSameEveryTime) {
  EXPECT_EQ(table(fly_sequences(7, 3, 5.0)), table(fly_sequences(7, 3, 5.0)));
}

}  // namespace
