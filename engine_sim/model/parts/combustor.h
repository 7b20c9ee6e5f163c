// SPDX-License-Identifier: Apache-2.0
#pragma once
// Combustor: complete mixing of air and fuel at constant enthalpy flow, with a pressure loss.
//   W4 = W3 + Wf,  f4 = Wf/W3 (the air carries no fuel yet),  P4 = P3 (1 - loss)
//   W4 h(T4, f4) = W3 h(T3, 0) + Wf (eff LHV + h_fuel)
// Units: kg/s, J/kg. h_fuel is the enthalpy of the injected fuel on the scale of gas.h. Errors: none.
// Source: Walsh & Fletcher, chapter 5 (combustor), energy balance.

#include "engine_sim/model/engine_data.h"
#include "engine_sim/model/thermo/stream.h"

namespace ehm::engine_sim {

template <class S>
Stream<S> burn(const CombustorData& data, const Stream<S>& in, const S& fuel_flow_kg_s) {
  const S w = in.w_kg_s + fuel_flow_kg_s;
  const S f = fuel_flow_kg_s / in.w_kg_s;
  const double heat_j_kg = data.efficiency * data.lower_heating_value_j_kg + data.fuel_enthalpy_j_kg;
  const S h = (in.w_kg_s * in.h_j_kg + fuel_flow_kg_s * heat_j_kg) / w;
  const double guess_k = value(in.tt_k) + 36000.0 * value(f);  // rise = f LHV / cp, about
  return {w, in.pt_pa * (1.0 - data.pressure_loss), temperature_at_enthalpy(h, f, guess_k), f, h};
}

}  // namespace ehm::engine_sim
