// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/solve/transient.h"

#include <stdexcept>
#include <string>

namespace ehm::engine_sim {

Transient::Transient(const Turbofan& engine, const SteadyPoint& start, HeatSoak heat_soak, Motion motion)
    : balance_(engine),
      heat_soak_(heat_soak),
      motion_(motion),
      state_{start.gas.speeds, start.gas.metal_k},  // in balance each lump has the gas temperature
      predicted_(start.unknowns) {}

const GasPath& Transient::output(const Operation& operation) {
  if (!present_ || !(present_->operation == operation)) {
    present_ = solve(operation, state_, predicted_, correction_);
  }
  return present_->gas;
}

void Transient::step(const Operation& operation, double dt_s) {
  if (!(dt_s > 0.0 && dt_s <= 0.1)) {
    throw std::invalid_argument("transient: dt_s = " + std::to_string(dt_s) + " is outside 0 to 0.1");
  }
  output(operation);
  const Solved now = *present_;
  // y* = y + dt f(y)
  const Solved then = solve(operation, moved(state_, now.gas, dt_s), now.unknowns, advance_);
  // y <- y + dt/2 (f(y) + f(y*))
  state_ = moved(moved(state_, now.gas, 0.5 * dt_s), then.gas, 0.5 * dt_s);
  correction_.add(predicted_, now.unknowns);
  advance_.add(now.unknowns, then.unknowns);
  predicted_ = then.unknowns;
  present_.reset();
}

void Transient::disturb(const SpoolSpeeds& change_rpm) {
  state_.speeds.n1_rpm += change_rpm.n1_rpm;
  state_.speeds.n2_rpm += change_rpm.n2_rpm;
  present_.reset();
}

Transient::State Transient::moved(const State& from, const GasPath& rates, double dt_s) {
  State to = from;
  to.speeds.n1_rpm += dt_s * rates.n1_dot_rpm_s;
  to.speeds.n2_rpm += dt_s * rates.n2_dot_rpm_s;
  for (std::size_t i = 0; i < metal_count; ++i) to.metal_k[i] += dt_s * rates.metal_dot_k_s[i];
  return to;
}

Transient::Solved Transient::solve(const Operation& operation, const State& at, const FlowUnknowns& last,
                                   const UnknownsTrend& trend) {
  const MetalTemperatures* metal = heat_soak_ == HeatSoak::with ? &at.metal_k : nullptr;
  if (motion_ == Motion::smooth) {
    Solved s{operation, trend.continued(last), {}};
    if (balance_.try_solve(operation, at.speeds, s.unknowns, s.gas, metal) == GasPathStatus::ok) return s;
  }
  Solved s{operation, last, {}};
  s.gas = balance_.solve(operation, at.speeds, s.unknowns, metal);
  return s;
}

}  // namespace ehm::engine_sim
