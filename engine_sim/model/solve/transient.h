// SPDX-License-Identifier: Apache-2.0
#pragma once
// Spool dynamics at a fixed step: dN/dt from the power left over on each shaft, the flow balance closed at each stage.
//   Heun (second order): y* = y + dt f(y),  y <- y + dt/2 (f(y) + f(y*)),  operation held over the step
// States y: N1, N2 in rpm; with heat soak also the three metal temperatures of heat_soak.h in K, which start in balance
// with the gas (no heat flows). dt in s. The volumes of the gas path are quasi-steady: they fill in milliseconds.
// Each balance starts from where the changes of the last steps lead (unknowns_trend.h), and from the last solution where
// that leads astray: after a step of wear, or in a restless flight, where noise is drawn at each step.
// Errors: those of Turbofan::gas_path; @throws std::invalid_argument if dt_s is not within 0 to 0.1 s.
// Source: Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I, II.1 (Heun's second-order method).

#include <optional>

#include "engine_sim/model/solve/flow_balance.h"
#include "engine_sim/model/solve/steady.h"
#include "engine_sim/model/solve/unknowns_trend.h"
#include "engine_sim/model/turbofan.h"

namespace ehm::engine_sim {

enum class HeatSoak { without, with };
enum class Motion { smooth, restless };

class Transient {
 public:
  Transient(const Turbofan& engine, const SteadyPoint& start, HeatSoak heat_soak = HeatSoak::without,
            Motion motion = Motion::smooth);

  /// Gas path at the present state with this operation acting now. Real-time safe: yes, unless it throws.
  const GasPath& output(const Operation& operation);
  /// Advances the state by dt_s. Real-time safe: yes, unless it throws.
  void step(const Operation& operation, double dt_s);
  /// Adds what does not come from the engine's own equations to the speeds. Real-time safe: yes.
  void disturb(const SpoolSpeeds& change_rpm);
  SpoolSpeeds speeds() const { return state_.speeds; }
  /// Of the metal; constant without heat soak.
  const MetalTemperatures& metal_k() const { return state_.metal_k; }

 private:
  struct State {
    SpoolSpeeds speeds;
    MetalTemperatures metal_k;
  };
  struct Solved {
    Operation operation;
    FlowUnknowns unknowns;
    GasPath gas;
  };

  static State moved(const State& from, const GasPath& rates, double dt_s);
  Solved solve(const Operation& operation, const State& at, const FlowUnknowns& last, const UnknownsTrend& trend);

  FlowBalance balance_;
  HeatSoak heat_soak_;
  Motion motion_;
  State state_;
  std::optional<Solved> present_;  ///< solved at the present state, so that step() after output() solves it once
  FlowUnknowns predicted_;         ///< solution at the last y*
  UnknownsTrend correction_;       ///< of the unknowns from y* to the next y
  UnknownsTrend advance_;          ///< of the unknowns from y to its y*
};

}  // namespace ehm::engine_sim
