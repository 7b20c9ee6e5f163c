// SPDX-License-Identifier: Apache-2.0
#pragma once
// Duct: total pressure falls by a fixed fraction, enthalpy and flow stay. P2 = P1 (1 - loss). Units: Pa, ratio.
// Errors: none. Source: Walsh & Fletcher, chapter 5 (ducts).

#include "engine_sim/model/thermo/stream.h"

namespace ehm::engine_sim {

template <class S>
Stream<S> duct(const Stream<S>& in, double pressure_loss) {
  Stream<S> out = in;
  out.pt_pa = in.pt_pa * (1.0 - pressure_loss);
  return out;
}

}  // namespace ehm::engine_sim
