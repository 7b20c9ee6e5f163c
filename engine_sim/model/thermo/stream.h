// SPDX-License-Identifier: Apache-2.0
#pragma once
// A stream of gas in total conditions, and what two streams become when they mix at constant enthalpy.
//   mixing: w = w1 + w2, w h = w1 h1 + w2 h2, air and fuel conserved separately; the pressure is the main stream's
// Units: kg/s, Pa, K, J/kg. Errors: none.

#include "engine_sim/model/gas_path.h"
#include "engine_sim/model/thermo/gas.h"

namespace ehm::engine_sim {

template <class S>
struct Stream {
  S w_kg_s;
  S pt_pa;
  S tt_k;
  S fuel_air_ratio;
  S h_j_kg;  ///< enthalpy(tt_k, fuel_air_ratio), carried along because every component needs it
};

template <class S>
Stream<S> make_stream(const S& w_kg_s, const S& pt_pa, const S& tt_k, const S& fuel_air_ratio) {
  return {w_kg_s, pt_pa, tt_k, fuel_air_ratio, enthalpy(tt_k, fuel_air_ratio)};
}

template <class S>
Stream<S> mix(const Stream<S>& main, const Stream<S>& added) {
  const S w = main.w_kg_s + added.w_kg_s;
  const S air = main.w_kg_s / (1.0 + main.fuel_air_ratio) + added.w_kg_s / (1.0 + added.fuel_air_ratio);
  const S f = w / air - 1.0;
  const S h = (main.w_kg_s * main.h_j_kg + added.w_kg_s * added.h_j_kg) / w;
  return {w, main.pt_pa, temperature_at_enthalpy(h, f, value(main.tt_k)), f, h};
}

/// The share of a stream: same state, another flow.
template <class S>
Stream<S> with_flow(const Stream<S>& in, const S& w_kg_s) {
  Stream<S> out = in;
  out.w_kg_s = w_kg_s;
  return out;
}

/// `T`: the stream's scalar, or double for the values alone.
template <class T = double, class S>
StationOf<T> to_station(const Stream<S>& in) {
  return {carried<T>(in.w_kg_s), carried<T>(in.pt_pa), carried<T>(in.tt_k), carried<T>(in.fuel_air_ratio)};
}

}  // namespace ehm::engine_sim
