// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/engines/jt9d.h"

#include "engine_sim/engines/jt9d_maps.h"
#include "engine_sim/model/units.h"

namespace ehm::engine_sim {
namespace {

// Source of every number, unless it says otherwise: the public JT9D model of nasa/T-MATS (JT9D.mdl, Apache-2.0).

// Recovery at the fan face: (0.992/0.995) times the table of the model.
InletData inlet() {
  constexpr double recovery = 0.992 / 0.995;
  return {{{0.0, recovery * 0.995},
           {0.1, recovery * 0.996},
           {0.2, recovery * 0.997},
           {0.3, recovery * 0.997},
           {0.4, recovery * 0.998},
           {0.9, recovery * 0.998}}};
}

// Not in the model. T40 some 3 % and T48 7 % above the design point's 1516.7 and 1187.5 K, room for a worn engine at
// its rating; P30 14 % above its 2.049 MPa for sea level on a cold day; speeds some 3 to 7 % above the highest of the
// NPSS cases (N1 3946 and 3944 corrected, N2 8051 rpm, 7958 corrected). Idle: in flight at the core speed of NPSS's
// lowest power code, 20, at low altitude (6534 to 6650 corrected; to 6930 at 35 000 ft); on the ground where the new
// engine gives 8 % of its design thrust.
Ratings ratings() {
  return {.t40_max_k = 1570.0,
          .t48_max_k = 1270.0,
          .p30_max_pa = 2.33e6,
          .n1_max_rpm = 4070.0,
          .n2_max_rpm = 8400.0,
          .corrected_n1_max_rpm = 4150.0,
          .corrected_n2_max_rpm = 8500.0,
          .ground_idle_corrected_n2_rpm = 6090.0,
          .flight_idle_corrected_n2_rpm = 6630.0};
}

EngineData make_jt9d() {
  // Map scale factors: speed rpm (compressors) or rpm/sqrt(R) per percent (turbines), flow, PR - 1, efficiency.
  const MapScale fan_scale{3943.959, 0.521629, 1.4369, 0.967977};
  const MapScale lpc_scale{3663.0036630036625, 0.932311, 3.2631, 0.96};
  const MapScale hpc_scale{6357.157841872056, 0.4206, 0.2163, 1.0137};
  // Not in the model, whose map holds on the vane schedule. Form as in GasTurb's correction for variable compressor
  // geometry (Kurzke: flow and pressure rise linear, efficiency quadratic in the angle); the numbers are assumptions:
  // 1 % of flow and of pressure rise per degree, 1 % of efficiency at 10 degrees.
  const VaneData hpc_vanes{.flow_per_deg = 0.01, .pressure_rise_per_deg = 0.01, .efficiency_per_deg2 = 1e-4};
  // HPT efficiency: 0.9803 of the model, times 0.9979 calibrated: ratio of the work in the 165 NPSS cases with power
  // code 40 and more to the work of this expansion with their PR and efficiency (0.9973 to 0.9988).
  const MapScale hpt_scale{1.53112, 1.4085, 0.425, 0.9803 * 0.9979};
  const MapScale lpt_scale{0.81019, 0.746331082, 0.7168813367829664, 1.001294};

  // Exit Mach number 0.30 at the design point (245.29 lbm/s, 297.13 psia, 1398.61 R) fixes the area of station 30:
  // Ps30/P30 = 0.9412 there; a test recomputes it.
  constexpr double hpc_exit_area_m2 = 0.0773474;

  const SecondaryAir air{.hpt_inlet = 0.055, .hpt_exit = 0.035};  // taken at the HPC exit

  // Fuel enthalpy: calibrated on the scale of gas.h, mean of (W4 h4 - W3 h3)/Wf - eff LHV over the 165 NPSS cases with
  // power code 40 and more (423.8 to 436.9 kJ/kg); it brings T4 within 0.02 % of them.
  constexpr double fuel_enthalpy_j_kg = 430.9e3;
  const CombustorData combustor{0.055, 0.994, 18400.0 * j_kg_per_btu_lbm, fuel_enthalpy_j_kg};

  const DuctLosses loss{
      .bypass = 0.0075, .fan_to_lpc = 0.0025, .lpc_to_hpc = 0.0025, .hpt_to_lpt = 0.005, .lpt_to_nozzle = 0.010};

  const NozzleData core_nozzle{862.88 * m2_per_in2, 0.9999};
  const NozzleData bypass_nozzle{2706.4 * m2_per_in2, 0.9975};

  // Heat soak, not in the model: some 600, 350 and 700 kg of metal at 500 J/(kg K) behind HPC, HPT and LPT, which
  // follow the gas with 25, 15 and 30 s. An estimate of the size of such an engine, for studies of its effect.
  const std::array<HeatSoakData, metal_count> metal{{{12.0e3, 300e3}, {11.7e3, 175e3}, {11.7e3, 350e3}}};

  // Sea level static, ISA + 27 R, T4 2730 R.
  DesignPoint design{{0.0, 0.0, 15.0}, {3750.0, 8000.0}, 17873.61 / 3600.0 * kg_per_lbm, {}};
  design.unknowns = {{5.2751, 2.0, 1.769, 2.08, 2.700, 4.584}};

  return {.name = "JT9D",
          .inlet = inlet(),
          .fan = {CompressorMap(jt9d_maps::fan()), fan_scale, {}},
          .lpc = {CompressorMap(jt9d_maps::lpc()), lpc_scale, {}},
          .hpc = {CompressorMap(jt9d_maps::hpc()), hpc_scale, hpc_vanes},
          .hpc_exit_area_m2 = hpc_exit_area_m2,
          .air = air,
          .combustor = combustor,
          .hpt = {TurbineMap(jt9d_maps::hpt()), hpt_scale},
          .lpt = {TurbineMap(jt9d_maps::lpt()), lpt_scale},
          .loss = loss,
          .core_nozzle = core_nozzle,
          .bypass_nozzle = bypass_nozzle,
          .lp_inertia_kg_m2 = 100.0 * kg_m2_per_slug_ft2,  // example values of the model
          .hp_inertia_kg_m2 = 20.0 * kg_m2_per_slug_ft2,
          .metal = metal,
          .ratings = ratings(),
          .design = design};
}

}  // namespace

const EngineData& jt9d() {
  static const EngineData data = make_jt9d();
  return data;
}

}  // namespace ehm::engine_sim
