// SPDX-License-Identifier: Apache-2.0
// The on-board model allocates nothing after its construction: along a slam, with derivatives, and where it has no
// answer.

#include <gtest/gtest.h>

#include <limits>

#include "engine_sim/engines/jt9d.h"
#include "engine_sim/model/onboard/on_board_engine.h"
#include "engine_sim/model/solve/transient.h"
#include "tests/unit/engine_sim/model/throttle_slam.h"
#include "tests/unit/monitor/estimation/allocation_counter.h"

namespace ehm::engine_sim {
namespace {

TEST(AllocationOfTheOnBoardEngine, NoneWithAnAnswerOrWithout) {
  const Turbofan engine(jt9d());
  const ThrottleSlam slam(engine, sea_level_static, 1.0);
  Transient run(engine, slam.idle(), HeatSoak::with);
  OnBoardEngine board(engine);
  GasPath gas;
  GasPathJacobian jacobian;
  int answered = 0, refused = 0;
  const long before = test::allocation_count();
  board.start(slam.idle().unknowns);
  for (int k = 0; k < 600; ++k) {
    Operation operation = slam.at(0.015 * k);
    run.step(operation, 0.015);
    if (k % 50 == 10) operation.fuel_flow_kg_s *= 20.0;
    if (k % 50 == 20) operation.flight.mach = 2.0;
    if (k % 50 == 30) operation.health[hpc_flow] = -0.9;
    if (k % 50 == 40) operation.health[hpc_flow] = std::numeric_limits<double>::quiet_NaN();
    const bool ok = board.evaluate(operation, run.speeds(), gas, &run.metal_k()) == GasPathStatus::ok &&
                    board.evaluate(operation, run.speeds(), gas, jacobian, &run.metal_k()) == GasPathStatus::ok;
    ++(ok ? answered : refused);
  }
  EXPECT_EQ(test::allocation_count(), before);
  EXPECT_EQ(refused, 48);
  EXPECT_EQ(answered, 552);
}

}  // namespace
}  // namespace ehm::engine_sim
