// SPDX-License-Identifier: Apache-2.0
#pragma once
// Everything that distinguishes one two-spool, separate-flow turbofan from another. SI unless a name says otherwise;
// the maps and their scale factors keep the units of the maps (lbm/s, degrees Rankine, psia).
// Scale factors (convention of NPSS and T-MATS):
//   compressor: Nc = N/sqrt(theta) = s_nc n,  Wc = s_wc WcMap,  PR = 1 + s_pr (PRmap - 1),  eff = s_eff effMap
//   turbine:    Np = N/sqrt(T) = s_nc NpMap,  Wp = s_wc WpMap, PR and eff as above; T, P, W of the inlet before cooling
// Errors: none. Source of a particular engine's numbers: its file in engines/.

#include <string>
#include <vector>

#include "engine_sim/model/gas_path.h"
#include "engine_sim/model/maps/compressor_map.h"
#include "engine_sim/model/maps/turbine_map.h"
#include "engine_sim/model/parts/heat_soak.h"
#include "engine_sim/model/solve/flow_unknowns.h"

namespace ehm::engine_sim {

struct RamRecovery {
  double mach;
  double recovery;  ///< fan face total pressure / free stream total pressure
};

struct InletData {
  std::vector<RamRecovery> ram_recovery;  ///< ascending Mach number
};

struct MapScale {
  double s_nc, s_wc, s_pr, s_eff;
};

/// Effect of stator vanes off their schedule by `a` degrees (positive closes) on a compressor:
///   Wc and PR - 1 are multiplied by 1 - flow_per_deg a and 1 - pressure_rise_per_deg a, efficiency by 1 - c a^2.
struct VaneData {
  double flow_per_deg = 0.0;
  double pressure_rise_per_deg = 0.0;
  double efficiency_per_deg2 = 0.0;
};

struct CompressorData {
  CompressorMap map;
  MapScale scale;
  VaneData vanes;  ///< none by default
};

struct TurbineData {
  TurbineMap map;
  MapScale scale;
};

/// Air that leaves the main stream, as fractions of the HPC's inlet flow. Turbine cooling at an inlet does work there,
/// at an exit it mixes behind. A port lies where the given fraction of the HPC's work has been done: 1 is its exit.
struct SecondaryAir {
  double hpt_inlet = 0.0, hpt_exit = 0.0;  ///< from the HPC exit
  double lpt_inlet = 0.0, lpt_exit = 0.0;  ///< from the LPT cooling port
  double lpt_port_work = 1.0;
  double customer_port_work = 1.0;
  double bypass_leak = 0.0;  ///< fraction of the bypass flow, lost overboard
};

struct CombustorData {
  double pressure_loss;  ///< dP/P
  double efficiency;
  double lower_heating_value_j_kg;
  double fuel_enthalpy_j_kg;  ///< of the fuel as injected, on the scale of gas.h
};

struct NozzleData {
  double area_m2;
  double velocity_coefficient;
};

/// Total pressure lost in each duct, dP/P.
struct DuctLosses {
  double bypass, fan_to_lpc, lpc_to_hpc, hpt_to_lpt, lpt_to_nozzle;
};

/// What bounds the steady power of the engine (ratings.h).
struct Ratings {
  double t40_max_k, t48_max_k, p30_max_pa, n1_max_rpm, n2_max_rpm;
  double corrected_n1_max_rpm, corrected_n2_max_rpm;                  ///< N/sqrt(theta2)
  double ground_idle_corrected_n2_rpm, flight_idle_corrected_n2_rpm;  ///< N2/sqrt(theta2)
};

/// A known operating point: where cold starts begin, and what scales the unknowns.
struct DesignPoint {
  FlightCondition flight;
  SpoolSpeeds speeds;
  double fuel_flow_kg_s;
  FlowUnknowns unknowns;
  Offtake offtake{};
};

struct EngineData {
  std::string name;
  InletData inlet;
  CompressorData fan, lpc, hpc;
  double hpc_exit_area_m2;  ///< flow area at station 30, where Ps30 is sensed
  SecondaryAir air;
  CombustorData combustor;
  TurbineData hpt, lpt;
  DuctLosses loss;
  NozzleData core_nozzle, bypass_nozzle;
  double lp_inertia_kg_m2, hp_inertia_kg_m2;
  std::array<HeatSoakData, metal_count> metal;
  Ratings ratings;
  DesignPoint design;
};

}  // namespace ehm::engine_sim
