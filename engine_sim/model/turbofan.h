// SPDX-License-Identifier: Apache-2.0
#pragma once
// Gas path of a two-spool turbofan with separate exhausts (its station diagram is cycle() in turbofan.cpp).
// At given spool speeds and fuel flow the six unknowns of flow_unknowns.h close six flow balances:
//   W22 = LPC capacity    W25 = HPC capacity    W40 = HPT capacity
//   W48 = LPT capacity    W7 = core nozzle      W15 = bypass nozzle
// Residuals are (flow - capacity)/flow; flow_balance.h closes them.
// The spools then accelerate by what is left of the power balances; at a steady point (steady.h) nothing is.
// Units SI. Source: Walsh & Fletcher, chapter 7 (matching); component equations in each component's header.

#include <array>
#include <optional>
#include <string_view>
#include <type_traits>

#include "engine_sim/model/engine_data.h"
#include "engine_sim/model/gas_path.h"
#include "engine_sim/model/parts/bleed.h"
#include "engine_sim/model/parts/inlet.h"
#include "engine_sim/model/parts/nozzle.h"
#include "engine_sim/model/parts/turbine.h"
#include "engine_sim/model/solve/newton.h"

namespace ehm::engine_sim {

/// All that acts on the engine from outside.
template <class S>
struct OperationOf {
  FlightCondition flight{};
  HealthVectorOf<S> health{};
  S fuel_flow_kg_s = 0.0;
  GeometryOf<S> geometry{};
  Offtake offtake{};
  bool operator==(const OperationOf&) const = default;
};
using Operation = OperationOf<double>;

inline constexpr std::array<std::string_view, flow_unknown_count> flow_balance_names{
    "LPC flow", "HPC flow", "HPT flow", "LPT flow", "core nozzle flow", "bypass nozzle flow"};

/// All of the gas path at one trial point: streams, powers, and how far each balance is from closing.
template <class S>
struct Cycle {
  Stream<S> s2, s13, s21, s24, s30, s40, s48, s50;
  S lp_turbine_power_w, lp_absorbed_power_w, hp_turbine_power_w, hp_absorbed_power_w;
  S gross_thrust_n, net_thrust_n;
  S core_nozzle_pressure_ratio, bypass_nozzle_pressure_ratio;
  Compression<S> fan, lpc, hpc;
  MetalTemperaturesOf<S> metal_heat_w{};
  std::array<S, flow_unknown_count> flow_residual;
};

/// What drives the cycle besides the operation: the spools, the fuel, and the flow unknowns.
template <class S>
struct CycleInput {
  S n1_rpm, n2_rpm, fuel_flow_kg_s;
  FlowUnknownsOf<S> unknowns;
};

/// What cannot flow in a closed cycle: a nozzle has no pressure ratio left, the combustor no air or more fuel or heat
/// than the gas data cover, the HPC's exit area is choked.
enum class FlowDefect { none, core_nozzle, bypass_nozzle, combustor, hpc_exit };

/// Whether a gas path was found, and why not: what was outside its range (controls: geometry and off-take), or not a
/// finite number, or the flows do not balance.
enum class GasPathStatus {
  ok,
  no_solution,
  not_finite,
  outside_flight,
  outside_speeds,
  outside_fuel,
  outside_health,
  outside_controls
};

/// The first value outside its range; `kind` is not_finite or what it belongs to.
struct InputDefect {
  GasPathStatus kind;
  std::string_view key;
  double value;
  const char* range;
};

class Turbofan {
 public:
  explicit Turbofan(const EngineData& data) : data_(data) {}

  /// Closes all flow balances from `unknowns`, which it updates, on its own; FlowBalance is faster along a flight.
  /// `metal`: temperatures for the heat soak, or none.
  /// @throws std::invalid_argument if speeds or operation are not finite or out of range (the message says which)
  /// @throws std::out_of_range for a flight condition outside the atmosphere's or the inlet's range
  /// @throws SolveError if a balance does not close, a nozzle has no pressure ratio left, or the combustor no air or
  /// more fuel or heat than the gas data cover
  GasPath gas_path(const Operation& operation, const SpoolSpeeds& speeds, FlowUnknowns& unknowns,
                   const MetalTemperatures* metal = nullptr) const;

  /// One evaluation along the station diagram; balances need not be closed. The fuel flow is that of `input`.
  /// S: scalar of the cycle; P: of health, geometry and metal temperatures, S or double.
  template <class S, class P>
  Cycle<S> cycle(const Intake& intake, const OperationOf<P>& operation, const CycleInput<S>& input,
                 const std::type_identity_t<MetalTemperaturesOf<P>>* metal = nullptr) const noexcept;

  /// What is published of a closed cycle, in its scalar or as plain values (T double); where something cannot flow,
  /// `gas` is not complete.
  template <class S, class T>
  FlowDefect publish(const CycleInput<S>& input, const Cycle<S>& cycle, GasPathOf<T>& gas) const noexcept;

  /// The same. @throws SolveError if something cannot flow
  template <class S>
  GasPath report(const CycleInput<S>& input, const Cycle<S>& cycle) const;

  const EngineData& data() const { return data_; }

 private:
  EngineData data_;
};

/// None if all is within its range. The flight condition has covers() in inlet.h.
std::optional<InputDefect> first_defect(const Operation& operation) noexcept;
std::optional<InputDefect> first_defect(const SpoolSpeeds& speeds) noexcept;

/// @throws std::invalid_argument if a value is not finite or outside its range; the message names key, value and range
void require_valid(const Operation& operation);
void require_valid(const SpoolSpeeds& speeds);

}  // namespace ehm::engine_sim
