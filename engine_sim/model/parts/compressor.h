// SPDX-License-Identifier: Apache-2.0
#pragma once
// Compressor (fan, LPC, HPC) on a scaled map, with real-gas isentropic compression:
//   n = N/(sqrt(theta) s_nc);  (WcMap, PRmap, effMap) = map(n, R)
//   Wc = s_wc f_W WcMap;  PR = 1 + s_pr f_PR (PRmap - 1);  eff = s_eff f_eff effMap
//   phi(T2s) = phi(T1) + R ln PR;  h2 = h1 + (h(T2s) - h1)/eff
// f: factors of health and of stator vanes off schedule, f_W = (1 + h_flow)(1 - a_W a), and so on (engine_data.h).
// A stream that leaves at a port where the fraction w of the work is done has h1 + w (h2 - h1); power counts it so.
// S is the scalar of the state, P that of the factors. theta = T1/288.15 K, delta = P1/14.696 psia. Units SI; map flow
// lbm/s. Errors: none; a non-finite state stays so. Source: Walsh & Fletcher, chapter 5; NPSS, T-MATS (engine_data.h).

#include "engine_sim/model/engine_data.h"
#include "engine_sim/model/thermo/stream.h"
#include "engine_sim/model/units.h"

namespace ehm::engine_sim {

/// Health of one component: deviations of efficiency and flow capacity from nominal, as fractions.
template <class P>
struct ComponentHealth {
  P efficiency;
  P flow;
};

/// What multiplies a scaled map.
template <class P>
struct MapFactors {
  P flow = 1.0, pressure_rise = 1.0, efficiency = 1.0;
};

template <class P>
MapFactors<P> map_factors(const ComponentHealth<P>& health, const VaneData& vanes = {},
                          const P& off_schedule_deg = 0.0) {
  return {(1.0 + health.flow) * (1.0 - vanes.flow_per_deg * off_schedule_deg),
          1.0 - vanes.pressure_rise_per_deg * off_schedule_deg,
          (1.0 + health.efficiency) * (1.0 - vanes.efficiency_per_deg2 * off_schedule_deg * off_schedule_deg)};
}

template <class S>
struct Compression {
  Stream<S> exit;
  S flow_capacity_kg_s;  ///< what the map passes at this speed and R-line
  S work_j_kg;           ///< of the air that stays to the exit
  S map_flow;            ///< corrected flow on the unscaled map, lbm/s
  S map_pressure_ratio;  ///< unscaled
};

/// The map read at one speed and R-line; the fan's flow capacity is what defines its inlet flow.
template <class S>
struct CompressorWorking {
  CompressorMapPoint<S> map;
  S flow_capacity_kg_s;
};

template <class S, class P>
CompressorWorking<S> read_map(const CompressorData& data, const S& pt_pa, const S& tt_k, const S& speed_rpm,
                              const S& r_line, const MapFactors<P>& factors) {
  using std::sqrt;
  const S root_theta = sqrt(tt_k / reference_temperature_k);
  const CompressorMapPoint<S> map = data.map.at(S(speed_rpm / (root_theta * data.scale.s_nc)), r_line);
  // W = Wc delta / sqrt(theta)
  const P capacity_scale = data.scale.s_wc * factors.flow * kg_per_lbm / reference_pressure_pa;
  return {map, capacity_scale * map.flow * pt_pa / root_theta};
}

template <class S, class P>
Compression<S> compress(const CompressorData& data, const Stream<S>& in, const CompressorWorking<S>& at,
                        const MapFactors<P>& factors) {
  using std::log;
  const S pressure_ratio = 1.0 + data.scale.s_pr * factors.pressure_rise * (at.map.pressure_ratio - 1.0);
  const S efficiency = data.scale.s_eff * factors.efficiency * at.map.efficiency;
  const S ideal_k = isentropic_temperature<P>(in.tt_k, in.fuel_air_ratio, S(log(pressure_ratio)));
  const S work_j_kg = (enthalpy(ideal_k, in.fuel_air_ratio) - in.h_j_kg) / efficiency;
  const S h_exit = in.h_j_kg + work_j_kg;
  const S t_exit = temperature_at_enthalpy(h_exit, in.fuel_air_ratio, value(ideal_k));
  const Stream<S> exit{in.w_kg_s, in.pt_pa * pressure_ratio * at.map.choke, t_exit, in.fuel_air_ratio, h_exit};
  return {exit, at.flow_capacity_kg_s, work_j_kg, at.map.flow, at.map.pressure_ratio};
}

/// Percent: 100 (PRsurge at the working corrected flow / working PR - 1), both from the unscaled map.
/// T: the state's scalar, or double for the value alone.
template <class T, class S>
T stall_margin_percent(const CompressorData& data, const Compression<S>& at) {
  return 100.0 * (data.map.surge_pressure_ratio(carried<T>(at.map_flow)) / carried<T>(at.map_pressure_ratio) - 1.0);
}

}  // namespace ehm::engine_sim
