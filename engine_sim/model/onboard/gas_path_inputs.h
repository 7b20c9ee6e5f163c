// SPDX-License-Identifier: Apache-2.0
#pragma once
// What drives the gas path at a fixed flight condition and off-take, as a vector with named places:
//   states (N1, N2, metal temperatures) | controls (fuel flow, vanes, bleed valves, nozzle) | health
// Units: those in the names. Without heat soak the metal's places are zero. Errors: none.

#include <array>
#include <cstddef>
#include <string_view>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/model/turbofan.h"

namespace ehm::engine_sim {

namespace gas_path_input {
enum Place : std::size_t {
  n1,
  n2,
  first_metal,
  fuel_flow = first_metal + metal_count,
  vsv,
  vbv,
  core_nozzle_area,
  first_health,
  count = first_health + health_count
};
constexpr std::size_t of(Health parameter) {
  return first_health + as_size(parameter);
}
inline constexpr std::array<std::string_view, first_health> names_before_health{
    "n1_rpm",         "n2_rpm",  "metal_hpc_k",  "metal_hpt_k",           "metal_lpt_k",
    "fuel_flow_kg_s", "vsv_deg", "vbv_fraction", "core_nozzle_area_ratio"};
constexpr std::string_view name(std::size_t place) {
  return place < first_health ? names_before_health[place] : health_names[place - first_health];
}
}  // namespace gas_path_input

template <class S>
using GasPathInputs = std::array<S, gas_path_input::count>;

/// Carries the derivatives by the six flow unknowns, then by the inputs.
using GasPathDual = Dual<flow_unknown_count + gas_path_input::count>;

/// The inputs where they act.
template <class S>
struct GasPathDrive {
  OperationOf<S> operation;
  SpoolSpeedsOf<S> speeds;
  MetalTemperaturesOf<S> metal;
};

inline GasPathInputs<double> inputs_of(const Operation& operation, const SpoolSpeeds& speeds,
                                       const MetalTemperatures* metal) {
  const auto& [vsv_deg, vbv_fraction, area_ratio] = operation.geometry;
  GasPathInputs<double> p{speeds.n1_rpm, speeds.n2_rpm, 0.0,       0.0, 0.0, operation.fuel_flow_kg_s,
                          vsv_deg,       vbv_fraction,  area_ratio};
  if (metal) std::copy(metal->begin(), metal->end(), p.begin() + gas_path_input::first_metal);
  std::copy(operation.health.begin(), operation.health.end(), p.begin() + gas_path_input::first_health);
  return p;
}

/// Flight condition and off-take of `held`, all else from `p`.
template <class S>
GasPathDrive<S> drive_of(const Operation& held, const GasPathInputs<S>& p) {
  using namespace gas_path_input;
  GasPathDrive<S> out{.operation = {.flight = held.flight, .fuel_flow_kg_s = p[fuel_flow], .offtake = held.offtake},
                      .speeds = {p[n1], p[n2]},
                      .metal = {}};
  out.operation.geometry = {p[vsv], p[vbv], p[core_nozzle_area]};
  std::copy_n(p.begin() + first_metal, metal_count, out.metal.begin());
  std::copy_n(p.begin() + first_health, health_count, out.operation.health.begin());
  return out;
}

}  // namespace ehm::engine_sim
