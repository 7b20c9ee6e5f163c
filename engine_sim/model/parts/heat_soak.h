// SPDX-License-Identifier: Apache-2.0
#pragma once
// Heat soak: gas and the metal of a component exchange heat, so that after a change of power the gas path settles only
// as the metal does.
//   q = k (T - Tm),  gas: h' = h - q/W behind the component,  metal: C dTm/dt = q
// In steady state q = 0 and the metal has the gas temperature. Optional: without metal temperatures there is no soak.
// Units: W/K, J/K, K. Errors: none. Source: Walsh & Fletcher, chapter 8 (heat soakage), one lump per component.

#include <array>

#include "engine_sim/model/thermo/stream.h"

namespace ehm::engine_sim {

/// Order of the lumps: behind the HPC, the HPT, the LPT.
enum Metal : std::size_t { hpc_metal, hpt_metal, lpt_metal };
inline constexpr std::size_t metal_count = 3;
template <class S>
using MetalTemperaturesOf = std::array<S, metal_count>;
using MetalTemperatures = MetalTemperaturesOf<double>;

struct HeatSoakData {
  double conductance_w_k;
  double capacity_j_k;
};

template <class S>
struct Soaked {
  Stream<S> gas;
  S heat_w;  ///< from the gas to the metal
};

template <class S, class P>
Soaked<S> soak(const HeatSoakData& data, const Stream<S>& in, const P& metal_k) {
  const S heat_w = data.conductance_w_k * (in.tt_k - metal_k);
  Stream<S> out = in;
  out.h_j_kg = in.h_j_kg - heat_w / in.w_kg_s;
  out.tt_k = temperature_at_enthalpy(out.h_j_kg, in.fuel_air_ratio, value(in.tt_k));
  return {out, heat_w};
}

}  // namespace ehm::engine_sim
