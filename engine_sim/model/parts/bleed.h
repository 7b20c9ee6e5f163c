// SPDX-License-Identifier: Apache-2.0
#pragma once
// Bleeds of the HPC: air for turbine cooling in fixed fractions of the HPC's inlet flow, and customer air in kg/s.
//   main: W_main = W (1 - sum of fractions) - W_customer, in the state of the HPC exit
//   a port at work fraction w: h = h25 + w (h30 - h25); the HPC does w of its work on that air
//   power = (h30 - h25) sum of W_i w_i,  w = 1 for what stays to the exit
// Units: kg/s, J/kg, W. Errors: none; turbofan.cpp refuses a solution in which no air is left for the combustor.
// Source: the bleed element of NPSS and T-MATS (fractions of flow and of work).

#include "engine_sim/model/engine_data.h"
#include "engine_sim/model/parts/compressor.h"
#include "engine_sim/model/thermo/stream.h"

namespace ehm::engine_sim {

template <class S>
struct Bleeds {
  Stream<S> main, to_hpt_inlet, to_hpt_exit, to_lpt_inlet, to_lpt_exit;
  S power_w;  ///< absorbed by the compressor for all of them together
};

/// Air that left at a port; its pressure there plays no part: it is throttled to where it goes.
template <class S>
Stream<S> at_port(const Stream<S>& in, const Compression<S>& compressor, const Stream<S>& exit, double work_fraction,
                  const S& w_kg_s) {
  if (work_fraction == 1.0) return with_flow(exit, w_kg_s);
  const S h = in.h_j_kg + work_fraction * compressor.work_j_kg;
  const double guess_k = value(in.tt_k) + work_fraction * (value(exit.tt_k) - value(in.tt_k));
  return {w_kg_s, exit.pt_pa, temperature_at_enthalpy(h, in.fuel_air_ratio, guess_k), in.fuel_air_ratio, h};
}

/// `in`: HPC inlet; `exit`: its exit as the bleeds find it (behind the heat soak).
template <class S, class P>
Bleeds<S> bleed_off(const Stream<S>& in, const Compression<S>& compressor, const Stream<S>& exit,
                    const SecondaryAir& air, const P& customer_bleed_kg_s) {
  const S w = in.w_kg_s;
  const double lpt = air.lpt_inlet + air.lpt_exit, hpt = air.hpt_inlet + air.hpt_exit;
  Bleeds<S> out;
  out.main = with_flow(exit, S(w * (1.0 - lpt - hpt) - customer_bleed_kg_s));
  out.to_hpt_inlet = with_flow(exit, S(w * air.hpt_inlet));
  out.to_hpt_exit = with_flow(exit, S(w * air.hpt_exit));
  out.to_lpt_inlet = at_port(in, compressor, exit, air.lpt_port_work, S(w * air.lpt_inlet));
  out.to_lpt_exit = at_port(in, compressor, exit, air.lpt_port_work, S(w * air.lpt_exit));
  const S full_work_kg_s =
      w * (1.0 - lpt * (1.0 - air.lpt_port_work)) - customer_bleed_kg_s * (1.0 - air.customer_port_work);
  out.power_w = full_work_kg_s * compressor.work_j_kg;
  return out;
}

}  // namespace ehm::engine_sim
