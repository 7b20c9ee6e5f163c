// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the engine model takes and gives, in SI units; stations are numbered as on the station diagram
// (2 fan face, 13 bypass fan exit, 21 core fan exit, 24 LPC exit before the duct, 30 HPC exit, 40 burner exit,
// 48 HPT exit after its duct, 50 LPT exit).
// What is a template over its scalar carries derivatives where the scalar is a dual number (solve/dual.h).

#include <array>
#include <cstddef>
#include <string_view>

namespace ehm::engine_sim {

/// Order of the ten health parameters, everywhere in the project.
enum Health : std::size_t {
  fan_efficiency,
  fan_flow,
  lpc_efficiency,
  lpc_flow,
  hpc_efficiency,
  hpc_flow,
  hpt_efficiency,
  hpt_flow,
  lpt_efficiency,
  lpt_flow
};
inline constexpr std::size_t health_count = 10;
inline constexpr std::array<std::string_view, health_count> health_names{
    "fan_efficiency", "fan_flow",       "lpc_efficiency", "lpc_flow",       "hpc_efficiency",
    "hpc_flow",       "hpt_efficiency", "hpt_flow",       "lpt_efficiency", "lpt_flow"};

/// Deviation of each health parameter from nominal as a fraction: -0.02 is 2 % lost.
template <class S>
using HealthVectorOf = std::array<S, health_count>;
using HealthVector = HealthVectorOf<double>;

struct FlightCondition {
  double altitude_m = 0.0;  ///< geopotential pressure altitude
  double mach = 0.0;
  double delta_isa_k = 0.0;  ///< ambient temperature minus the standard atmosphere's
  bool operator==(const FlightCondition&) const = default;
};

/// Variable geometry besides the fuel valve.
template <class S>
struct GeometryOf {
  S vsv_deg = 0.0;                 ///< HPC stator vanes off their schedule, positive closes
  S vbv_fraction = 0.0;            ///< of the LPC exit flow, through the bleed valves to the bypass
  S core_nozzle_area_ratio = 1.0;  ///< to the nominal area
  bool operator==(const GeometryOf&) const = default;
};
using Geometry = GeometryOf<double>;

/// What the aircraft takes from the engine.
struct Offtake {
  double customer_bleed_kg_s = 0.0;  ///< air from the HPC's customer port
  double power_w = 0.0;              ///< from the HP shaft
  bool operator==(const Offtake&) const = default;
};

template <class S>
struct SpoolSpeedsOf {
  S n1_rpm = 0.0;
  S n2_rpm = 0.0;
};
using SpoolSpeeds = SpoolSpeedsOf<double>;

/// Total state of the gas at one station.
template <class S>
struct StationOf {
  S w_kg_s = 0.0;
  S pt_pa = 0.0;
  S tt_k = 0.0;
  S fuel_air_ratio = 0.0;
};
using Station = StationOf<double>;

/// One solved instant of the gas path: flow balances hold, spools may accelerate.
template <class S>
struct GasPathOf {
  StationOf<S> s2, s13, s21, s24, s30, s40, s48, s50;
  S ps_30_pa = 0.0;  ///< static pressure at the HPC exit
  SpoolSpeedsOf<S> speeds;
  S n1_dot_rpm_s = 0.0;
  S n2_dot_rpm_s = 0.0;
  S fuel_flow_kg_s = 0.0;
  S net_thrust_n = 0.0;
  S gross_thrust_n = 0.0;
  S bypass_ratio = 0.0;
  S overall_pressure_ratio = 0.0;
  S stall_margin_fan_percent = 0.0;  ///< constant corrected flow, surge and working PR from the unscaled map
  S stall_margin_lpc_percent = 0.0;
  S stall_margin_hpc_percent = 0.0;
  std::array<S, 3> metal_k{};        ///< heat soak (heat_soak.h); without it that of the gas
  std::array<S, 3> metal_dot_k_s{};  ///< zero without heat soak
};
using GasPath = GasPathOf<double>;

}  // namespace ehm::engine_sim
