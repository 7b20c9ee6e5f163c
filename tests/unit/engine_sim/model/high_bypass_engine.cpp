// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/engine_sim/model/high_bypass_engine.h"

#include "engine_sim/engines/jt9d_maps.h"
#include "engine_sim/model/units.h"

namespace ehm::engine_sim {

// Source of every number, unless it says otherwise: pyCycle, example_cycles/high_bypass_turbofan.py (NASA, Apache-2.0).
EngineDesign high_bypass_design() {
  constexpr double watt_per_hp = 745.69987158227022;
  // The map shapes are the JT9D's, scaled to this design point: at the design point only the point counts.
  const CompressorDesign fan{CompressorMap(jt9d_maps::fan()), 1.685, 0.8948};
  const CompressorDesign lpc{CompressorMap(jt9d_maps::lpc()), 1.935, 0.9243};
  const CompressorDesign hpc{CompressorMap(jt9d_maps::hpc()), 9.369, 0.8707};
  const TurbineDesign hpt{TurbineMap(jt9d_maps::hpt()), 0.8888};
  const TurbineDesign lpt{TurbineMap(jt9d_maps::lpt()), 0.8996};

  // Fractions of the HPC inlet flow. The HPT's air leaves behind the ports at the HPC exit, where pyCycle counts it as
  // fractions .067214 and .101256 of what is left there.
  constexpr double customer = 0.0445, to_lpt_inlet = 0.050708, to_lpt_exit = 0.020274;
  constexpr double left = 1.0 - customer - to_lpt_inlet - to_lpt_exit;
  const SecondaryAir air{.hpt_inlet = 0.067214 * left,
                         .hpt_exit = 0.101256 * left,
                         .lpt_inlet = to_lpt_inlet,
                         .lpt_exit = to_lpt_exit,
                         .lpt_port_work = 0.5,
                         .customer_port_work = 0.5,
                         .bypass_leak = 0.005};

  // Fuel C12H23 (167.316 g/mol), which that version of pyCycle injects with zero enthalpy on the scale of the heats of
  // formation (combustor.py), so that it releases those of its products alone: 12 CO2 of -393.51 kJ/mol and 11.5 H2O of
  // -241.83 kJ/mol, 44.844 MJ/kg, and no more at 298.15 K: fuel_enthalpy is that temperature's on the scale of gas.h.
  constexpr double f = 0.025;
  const double fuel_enthalpy_j_kg =
      ((1.0 + f) * enthalpy_property(298.15, f).value - enthalpy_property(298.15, 0.0).value) / f;
  const CombustorData combustor{0.0540, 1.0, 44.844e6, fuel_enthalpy_j_kg};

  return {.name = "high-bypass turbofan",
          .flight = {35000.0 * m_per_ft, 0.8, 0.0},
          .net_thrust_n = 5900.0 * n_per_lbf,
          .t40_k = 2857.0 / rankine_per_kelvin,
          .bypass_ratio = 5.105,
          .speeds = {4666.1, 14705.7},
          .inlet = {{{0.0, 0.9990}, {0.9, 0.9990}}},
          .fan = fan,
          .lpc = lpc,
          .hpc = hpc,
          .hpt = hpt,
          .lpt = lpt,
          .air = air,
          .combustor = combustor,
          .loss = {.bypass = 0.0149,
                   .fan_to_lpc = 0.0048,
                   .lpc_to_hpc = 0.0101,
                   .hpt_to_lpt = 0.0051,
                   .lpt_to_nozzle = 0.0107},
          .core_velocity_coefficient = 0.9933,
          .bypass_velocity_coefficient = 0.9939,
          .customer_bleed = customer,
          .power_offtake_w = 250.0 * watt_per_hp,
          // not in the source: guesses of the size of such an engine, of no effect on its steady points
          .lp_inertia_kg_m2 = 30.0,
          .hp_inertia_kg_m2 = 3.0,
          .metal = {{{4.0e3, 80e3}, {4.0e3, 50e3}, {4.0e3, 100e3}}},
          .ratings = {.t40_max_k = 1650.0,
                      .t48_max_k = 1300.0,
                      .p30_max_pa = 3.3e6,
                      .n1_max_rpm = 4900.0,
                      .n2_max_rpm = 15400.0,
                      .corrected_n1_max_rpm = 5250.0,
                      .corrected_n2_max_rpm = 16700.0,
                      .ground_idle_corrected_n2_rpm = 12400.0,
                      .flight_idle_corrected_n2_rpm = 13500.0}};
}

}  // namespace ehm::engine_sim
