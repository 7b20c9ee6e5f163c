#pragma once
// What the engine model takes and gives, in SI units; stations are numbered as on the station diagram
// (2 fan face, 13 bypass fan exit, 21 core fan exit, 24 LPC exit before the duct, 30 HPC exit, 40 burner exit,
// 48 HPT exit after its duct, 50 LPT exit).

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
using HealthVector = std::array<double, health_count>;

struct FlightCondition {
  double altitude_m = 0.0;  ///< geopotential pressure altitude
  double mach = 0.0;
  double delta_isa_k = 0.0;  ///< ambient temperature minus the standard atmosphere's
  bool operator==(const FlightCondition&) const = default;
};

/// Variable geometry besides the fuel valve.
struct Geometry {
  double vsv_deg = 0.0;                 ///< HPC stator vanes off their schedule, positive closes
  double vbv_fraction = 0.0;            ///< of the LPC exit flow, through the bleed valves to the bypass
  double core_nozzle_area_ratio = 1.0;  ///< to the nominal area
  bool operator==(const Geometry&) const = default;
};

/// What the aircraft takes from the engine.
struct Offtake {
  double customer_bleed_kg_s = 0.0;  ///< air from the HPC's customer port
  double power_w = 0.0;              ///< from the HP shaft
  bool operator==(const Offtake&) const = default;
};

struct SpoolSpeeds {
  double n1_rpm = 0.0;
  double n2_rpm = 0.0;
};

/// Total state of the gas at one station.
struct Station {
  double w_kg_s = 0.0;
  double pt_pa = 0.0;
  double tt_k = 0.0;
  double fuel_air_ratio = 0.0;
};

/// One solved instant of the gas path: flow balances hold, spools may accelerate.
struct GasPath {
  Station s2, s13, s21, s24, s30, s40, s48, s50;
  double ps_30_pa = 0.0;  ///< static pressure at the HPC exit
  SpoolSpeeds speeds;
  double n1_dot_rpm_s = 0.0;
  double n2_dot_rpm_s = 0.0;
  double fuel_flow_kg_s = 0.0;
  double net_thrust_n = 0.0;
  double gross_thrust_n = 0.0;
  double bypass_ratio = 0.0;
  double overall_pressure_ratio = 0.0;
  double stall_margin_fan_percent = 0.0;  ///< constant corrected flow, surge and working PR from the unscaled map
  double stall_margin_lpc_percent = 0.0;
  double stall_margin_hpc_percent = 0.0;
  std::array<double, 3> metal_k{};        ///< heat soak (heat_soak.h); without it that of the gas
  std::array<double, 3> metal_dot_k_s{};  ///< zero without heat soak
};

}  // namespace ehm::engine_sim
