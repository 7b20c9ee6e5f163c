// SPDX-License-Identifier: Apache-2.0
// The transient allocates nothing after its construction, neither on a slam nor at a leap.

#include <gtest/gtest.h>

#include "engine_sim/engines/jt9d.h"
#include "engine_sim/model/solve/transient.h"
#include "tests/unit/engine_sim/model/throttle_slam.h"
#include "tests/unit/monitor/estimation/allocation_counter.h"

namespace ehm::engine_sim {
namespace {

TEST(AllocationOfTheTransient, TheCounterCounts) {
  const long before = test::allocation_count();
  ::operator delete(::operator new(1));  // a new expression could be optimised away
  EXPECT_EQ(test::allocation_count(), before + 1);
}

TEST(AllocationOfTheTransient, NoneInOutputAndStep) {
  const Turbofan engine(jt9d());
  const ThrottleSlam slam(engine, sea_level_static, 1.0);
  Transient run(engine, slam.idle(), HeatSoak::with);
  const long before = test::allocation_count();
  for (int k = 0; k < 1200; ++k) {
    Operation operation = slam.at(0.015 * k);
    if (k == 900) operation.fuel_flow_kg_s *= 1.5;  // a leap
    run.output(operation);
    run.step(operation, 0.015);
  }
  EXPECT_EQ(test::allocation_count(), before);
}

}  // namespace
}  // namespace ehm::engine_sim
