// SPDX-License-Identifier: Apache-2.0
#pragma once
// Turbine (HPT, LPT) on a scaled map, with real-gas expansion and cooling air at its inlet:
//   NpMap = N/sqrt(T[R])/s_nc;  (WpMap, effMap) = map(NpMap, PRmap);  PR = 1 + s_pr (PRmap - 1)
//   flow capacity = s_wc f_W WpMap P/sqrt(T);  eff = s_eff f_eff effMap,  f: factors of health
//   phi(T2s) = phi(T1) - R ln PR;  h2 = h1 - eff (h1 - h(T2s));  power = W (h1 - h2)
// Map coordinates and flow capacity belong to the gas before its inlet cooling air; the expansion starts from the
// mixture. Units SI; map parameters in rpm/sqrt(R), lbm/s sqrt(R)/psia. Errors: none; a non-finite state stays
// non-finite. Source: Walsh & Fletcher, chapter 5; scaling of NPSS and T-MATS (engine_data.h).

#include "engine_sim/model/engine_data.h"
#include "engine_sim/model/parts/compressor.h"
#include "engine_sim/model/thermo/stream.h"
#include "engine_sim/model/units.h"

namespace ehm::engine_sim {

template <class S>
struct Expansion {
  Stream<S> exit;
  S flow_capacity_kg_s;  ///< of the gas before cooling
  S power_w;             ///< delivered
};

/// `in`: before cooling; `mixed`: with the inlet cooling air (the same stream where there is none).
template <class S, class P>
Expansion<S> expand(const TurbineData& data, const Stream<S>& in, const Stream<S>& mixed, const S& speed_rpm,
                    const S& pressure_ratio, const MapFactors<P>& factors) {
  using std::log, std::sqrt;
  const S root_t = sqrt(in.tt_k * rankine_per_kelvin);
  const S map_pressure_ratio = 1.0 + (pressure_ratio - 1.0) / data.scale.s_pr;
  const TurbineMapPoint<S> map = data.map.at(S(speed_rpm / (root_t * data.scale.s_nc)), map_pressure_ratio);
  const P capacity_scale = data.scale.s_wc * factors.flow * kg_per_lbm / pa_per_psi;
  const S flow_capacity = capacity_scale * map.flow * in.pt_pa / root_t;

  const S efficiency = data.scale.s_eff * factors.efficiency * map.efficiency;
  const S ideal_k = isentropic_temperature<P>(mixed.tt_k, mixed.fuel_air_ratio, S(-log(pressure_ratio)));
  const S work_j_kg = efficiency * (mixed.h_j_kg - enthalpy(ideal_k, mixed.fuel_air_ratio));
  const S h_exit = mixed.h_j_kg - work_j_kg;
  const S t_exit = temperature_at_enthalpy(h_exit, mixed.fuel_air_ratio, value(ideal_k));
  const Stream<S> exit{mixed.w_kg_s, mixed.pt_pa / pressure_ratio, t_exit, mixed.fuel_air_ratio, h_exit};
  return {exit, flow_capacity, mixed.w_kg_s * work_j_kg};
}

}  // namespace ehm::engine_sim
