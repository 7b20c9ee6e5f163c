// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/onboard/on_board_engine.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ehm::engine_sim {
namespace {

template <std::size_t N>
bool all_finite(const std::array<double, N>& values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

FlightCondition mean(const FlightCondition& a, const FlightCondition& b) {
  return {std::midpoint(a.altitude_m, b.altitude_m), std::midpoint(a.mach, b.mach),
          std::midpoint(a.delta_isa_k, b.delta_isa_k)};
}

/// Half-way from the new engine at its design point; the metal is that of `there`.
GasPathDrive<double> half_way(const DesignPoint& design, const Operation& operation, const SpoolSpeeds& speeds,
                              const MetalTemperatures* metal) {
  const Operation there{.flight = mean(design.flight, operation.flight), .offtake = operation.offtake};
  const auto from = inputs_of(Operation{.fuel_flow_kg_s = design.fuel_flow_kg_s}, design.speeds, metal);
  auto p = inputs_of(operation, speeds, metal);
  for (std::size_t i = 0; i < p.size(); ++i) p[i] = std::midpoint(from[i], p[i]);
  return drive_of(there, p);
}

}  // namespace

OnBoardEngine::OnBoardEngine(const Turbofan& engine)
    : engine_(engine), balance_(engine), last_(engine.data().design.unknowns) {}

void OnBoardEngine::start(const FlowUnknowns& near) noexcept {
  last_ = near;
  tangent_.forget();
}

GasPathStatus OnBoardEngine::close(const Operation& operation, const SpoolSpeeds& speeds,
                                   const MetalTemperatures* metal, FlowUnknowns& x, GasPath& gas) noexcept {
  x = tangent_.continued(inputs_of(operation, speeds, metal), balance_.intake()).value_or(last_);
  const GasPathStatus status = balance_.try_solve(operation, speeds, x, gas, metal);
  return status == GasPathStatus::no_solution ? close_from_design(operation, speeds, metal, x, gas) : status;
}

GasPathStatus OnBoardEngine::close_from_design(const Operation& operation, const SpoolSpeeds& speeds,
                                               const MetalTemperatures* metal, FlowUnknowns& x, GasPath& gas) noexcept {
  const DesignPoint& design = engine_.data().design;
  const auto way = half_way(design, operation, speeds, metal);
  x = design.unknowns;
  const GasPathStatus status = balance_.try_solve(way.operation, way.speeds, x, gas, metal ? &way.metal : nullptr);
  return status == GasPathStatus::ok ? balance_.try_solve(operation, speeds, x, gas, metal) : status;
}

GasPathStatus OnBoardEngine::evaluate(const Operation& operation, const SpoolSpeeds& speeds, GasPath& gas,
                                      const MetalTemperatures* metal) noexcept {
  GasPathStatus status = balance_.prepare(operation, speeds);
  if (status != GasPathStatus::ok) return status;
  if (metal && !all_finite(*metal)) return GasPathStatus::not_finite;
  GasPath found;
  FlowUnknowns x;
  status = close(operation, speeds, metal, x, found);
  if (status != GasPathStatus::ok) return status;
  if (!all_finite(quantities_of(found))) return GasPathStatus::not_finite;
  tangent_.solved(inputs_of(operation, speeds, metal), balance_.intake(), x);
  last_ = x;
  gas = found;
  return status;
}

GasPathStatus OnBoardEngine::evaluate(const Operation& operation, const SpoolSpeeds& speeds, GasPath& gas,
                                      GasPathJacobian& jacobian, const MetalTemperatures* metal) noexcept {
  GasPath found;
  const GasPathStatus status = evaluate(operation, speeds, found, metal);
  if (status != GasPathStatus::ok) return status;
  const auto slopes = differentiate(engine_, balance_.intake(), operation, speeds, last_, metal, jacobian);
  if (!slopes) return GasPathStatus::no_solution;
  tangent_.turn(*slopes);
  balance_.continue_with(slopes->inverse_jacobian);
  gas = found;
  return status;
}

GasPathStatus OnBoardEngine::evaluate_nearby(const Turbofan& engine, const Operation& operation,
                                             const SpoolSpeeds& speeds, GasPath& gas, const MetalTemperatures* metal,
                                             double tolerance) const noexcept {
  FlowBalance balance(engine, balance_, tolerance);
  const GasPathStatus status = balance.prepare(operation, speeds);
  if (status != GasPathStatus::ok) return status;
  FlowUnknowns x = tangent_.continued(inputs_of(operation, speeds, metal), balance.intake()).value_or(last_);
  return balance.try_solve(operation, speeds, x, gas, metal);
}

}  // namespace ehm::engine_sim
