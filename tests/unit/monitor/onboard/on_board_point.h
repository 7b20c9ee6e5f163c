// SPDX-License-Identifier: Apache-2.0
#pragma once
// An on-board engine at cruise, its tangent taken a little out of balance, so that spools and metal move.

#include <memory>

#include "engine_sim/engines/jt9d_engine.h"
#include "engine_sim/model/solve/steady.h"
#include "monitor/onboard/engine_tangent.h"

namespace ehm::onboard::test {

struct OnBoardPoint {
  std::shared_ptr<const OnBoardModel> model;
  engine_sim::Operation operation;
  EngineMotion motion;
  EngineTangent tangent;
};

inline OnBoardPoint on_board_cruise(const OnBoardOptions& options = {}) {
  auto model = std::make_shared<const OnBoardModel>(engine_sim::default_engine(), options);
  const auto steady = engine_sim::solve_steady(model->engine(), {10668.0, 0.8, 0.0}, {-0.01, 0.005},
                                               {engine_sim::DemandKind::n1_rpm, 3600.0});
  OnBoardPoint point{model, steady.operation, {}, EngineTangent(model)};
  point.operation.offtake = {0.5, 5e4};
  point.motion.speeds = {1.01 * steady.gas.speeds.n1_rpm, 0.995 * steady.gas.speeds.n2_rpm};
  point.motion.metal_k = {steady.gas.s30.tt_k - 10.0, steady.gas.s48.tt_k + 20.0, steady.gas.s50.tt_k - 15.0};
  if (!point.tangent.answer(point.operation, point.motion)) throw std::runtime_error("no answer at cruise");
  return point;
}

}  // namespace ehm::onboard::test
