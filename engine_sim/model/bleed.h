#pragma once
// Bleed at a compressor's exit: cooling air leaves the main stream in fixed fractions of the compressor's flow, in the
// state of the exit. W_main = W (1 - a - b), W_a = a W, W_b = b W. Units: kg/s. Errors: none.
// Source: the bleed element of NPSS and T-MATS, exit bleeds with full work and pressure.

#include "engine_sim/model/engine_data.h"
#include "engine_sim/model/stream.h"

namespace ehm::engine {

template <class S>
struct Bleeds {
  Stream<S> main, to_hpt_inlet, to_hpt_exit;
};

template <class S>
Bleeds<S> bleed_off(const Stream<S>& compressor_exit, const CoolingData& cooling) {
  const S w = compressor_exit.w_kg_s;
  return {with_flow(compressor_exit, S(w * (1.0 - cooling.hpt_inlet - cooling.hpt_exit))),
          with_flow(compressor_exit, S(w * cooling.hpt_inlet)), with_flow(compressor_exit, S(w * cooling.hpt_exit))};
}

}  // namespace ehm::engine
