#pragma once
// Gas path of a two-spool turbofan with separate exhausts (its station diagram is cycle() in turbofan.cpp).
// At given spool speeds and fuel flow the six unknowns of flow_unknowns.h close six flow balances:
//   W22 = LPC capacity    W25 = HPC capacity    W40 = HPT capacity
//   W48 = LPT capacity    W7 = core nozzle      W15 = bypass nozzle
// Residuals are (flow - capacity)/flow; flow_balance.h closes them.
// The spools then accelerate by what is left of the power balances; at a steady point (steady.h) nothing is.
// Units SI. Source: Walsh & Fletcher, chapter 7 (matching); component equations in each component's header.

#include <array>
#include <string_view>

#include "engine_sim/model/engine_data.h"
#include "engine_sim/model/gas_path.h"
#include "engine_sim/model/parts/bleed.h"
#include "engine_sim/model/parts/inlet.h"
#include "engine_sim/model/parts/nozzle.h"
#include "engine_sim/model/parts/turbine.h"
#include "engine_sim/model/solve/newton.h"

namespace ehm::engine_sim {

/// All that acts on the engine from outside.
struct Operation {
  FlightCondition flight{};
  HealthVector health{};
  double fuel_flow_kg_s = 0.0;
  Geometry geometry{};
  Offtake offtake{};
  bool operator==(const Operation&) const = default;
};

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
  std::array<S, metal_count> metal_heat_w{};
  std::array<S, flow_unknown_count> flow_residual;
};

/// What drives the cycle besides the operation: the spools, the fuel, and the flow unknowns.
template <class S>
struct CycleInput {
  S n1_rpm, n2_rpm, fuel_flow_kg_s;
  FlowUnknownsOf<S> unknowns;
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
  template <class S>
  Cycle<S> cycle(const Intake& intake, const Operation& operation, const CycleInput<S>& input,
                 const MetalTemperatures* metal = nullptr) const;

  /// What is published of a closed cycle.
  template <class S>
  GasPath report(const CycleInput<S>& input, const Cycle<S>& cycle) const;

  const EngineData& data() const { return data_; }

 private:
  EngineData data_;
};

/// @throws std::invalid_argument if a value is not finite or outside its range; the message names key, value and range
void require_valid(const Operation& operation);
void require_valid(const SpoolSpeeds& speeds);

}  // namespace ehm::engine_sim
