// SPDX-License-Identifier: Apache-2.0
#pragma once
// The engine as on-board model: the gas path at given spool speeds and operation, and its derivatives, within the cycle
// of an estimator. What has no answer is told by a status: nothing is thrown, nothing allocated.
// Each solution is the start of the next, moved along the tangent of the last derivatives (unknowns_tangent.h) if there
// are any: ask for derivatives now and then also where only values are wanted. From there the balances are closed as in
// flow_balance.h; what finds no solution so is approached once more from the engine's design point, by way of the point
// half-way from there. A refusal takes at most 90 exact evaluations of the cycle, that of an input out of range none.
// Values: those of Turbofan::gas_path to 1e-9. The same sequence of calls gives the same numbers. Units SI.

#include "engine_sim/model/onboard/unknowns_tangent.h"
#include "engine_sim/model/solve/flow_balance.h"

namespace ehm::engine_sim {

class OnBoardEngine {
 public:
  /// Starts at the engine's design point. `engine` must live as long as this.
  explicit OnBoardEngine(const Turbofan& engine);

  /// The next evaluation starts from here, and no tangent is known.
  void start(const FlowUnknowns& near) noexcept;

  /// `metal`: temperatures for the heat soak, or none. Unless the status is ok, the results keep what they held, and
  /// the next call starts as this one did. Real-time safe: yes.
  GasPathStatus evaluate(const Operation& operation, const SpoolSpeeds& speeds, GasPath& gas,
                         const MetalTemperatures* metal = nullptr) noexcept;
  /// With the derivatives.
  GasPathStatus evaluate(const Operation& operation, const SpoolSpeeds& speeds, GasPath& gas, GasPathJacobian& jacobian,
                         const MetalTemperatures* metal = nullptr) noexcept;

  /// A slightly different engine, or this one under a slightly different operation, from the last solution, moved along
  /// the tangent; the next evaluation starts as if this one had not been. The balances close to `tolerance`.
  /// Real-time safe: yes.
  GasPathStatus evaluate_nearby(const Turbofan& engine, const Operation& operation, const SpoolSpeeds& speeds,
                                GasPath& gas, const MetalTemperatures* metal = nullptr,
                                double tolerance = FlowBalance::closed) const noexcept;

  /// Of the last solution.
  const FlowUnknowns& unknowns() const noexcept { return last_; }

 private:
  GasPathStatus close(const Operation& operation, const SpoolSpeeds& speeds, const MetalTemperatures* metal,
                      FlowUnknowns& x, GasPath& gas) noexcept;
  GasPathStatus close_from_design(const Operation& operation, const SpoolSpeeds& speeds, const MetalTemperatures* metal,
                                  FlowUnknowns& x, GasPath& gas) noexcept;

  const Turbofan& engine_;
  FlowBalance balance_;
  UnknownsTangent tangent_;
  FlowUnknowns last_;
};

}  // namespace ehm::engine_sim
