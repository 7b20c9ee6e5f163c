// SPDX-License-Identifier: Apache-2.0
#pragma once
// From a design point to an engine: component pressure ratios and efficiencies, T40, bypass ratio, speeds and thrust
// determine the flow, the turbines' expansion ratios, the map scale factors and the nozzle areas.
//   unknowns (3):  fuel flow, expansion ratio of HPT and LPT      residuals: T40, power of both shafts
//   then, with a map read at its own design point (n, R) or (Np, PR):
//     s_pr = (PR - 1)/(PRmap - 1),  s_eff = eff/effMap,  s_nc = corrected speed/n,
//     s_wc and nozzle areas so that every flow balance of turbofan.h closes, the fan's s_wc so that the thrust is met
// The cycle itself is Turbofan::cycle: what is sized and what flies are one model.
// Units SI, degrees of the maps as in engine_data.h. Errors: @throws SolveError if no engine meets the design (the
// message names T40 or the shaft); those of intake(). Source: design point calculation, Walsh & Fletcher, chapter 6.

#include <string>

#include "engine_sim/model/engine_data.h"
#include "engine_sim/model/turbofan.h"

namespace ehm::engine_sim {

struct CompressorDesign {
  CompressorMap map;
  double pressure_ratio;
  double efficiency;  ///< isentropic
  VaneData vanes{};
  double map_speed = 1.0, map_r_line = 2.0;  ///< where the design point lies on the map
};

struct TurbineDesign {
  TurbineMap map;
  double efficiency;                                   ///< isentropic
  double map_speed = 100.0, map_pressure_ratio = 5.0;  ///< where the design point lies on the map
};

struct EngineDesign {
  std::string name;
  FlightCondition flight;
  double net_thrust_n;
  double t40_k;
  double bypass_ratio;
  SpoolSpeeds speeds;
  InletData inlet;
  CompressorDesign fan, lpc, hpc;
  TurbineDesign hpt, lpt;
  SecondaryAir air;
  CombustorData combustor;
  DuctLosses loss;
  double core_velocity_coefficient, bypass_velocity_coefficient;
  double hpc_exit_mach = 0.3;
  double customer_bleed = 0.0;  ///< fraction of the HPC's inlet flow, at the design point
  double power_offtake_w = 0.0;
  double lp_inertia_kg_m2, hp_inertia_kg_m2;
  std::array<HeatSoakData, metal_count> metal;
  Ratings ratings;
};

struct SizedEngine {
  EngineData data;
  Operation design;  ///< with the off-take and the fuel flow of the design point
};

SizedEngine size_engine(const EngineDesign& design);

}  // namespace ehm::engine_sim
