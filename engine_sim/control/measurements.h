// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the control measures, and the corrected quantities that it schedules with:
//   theta2 = T2/288.15 K, delta2 = P2/101 325 Pa (to the maps' reference state), Nc = N/sqrt(theta2)
//   ratio units: Wf/(Ps30 theta2^m), kg/s per MPa; fuel flow goes with delta and theta^m, Ps30 with delta
// The control has pick-ups of its own, quick and without noise: they are not among the monitored sensors.
// Source: Walsh & Fletcher, chapter 4 (parameter groups). Errors: none. Real-time safe: yes.

#include <cmath>

#include "engine_sim/model/gas_path.h"
#include "engine_sim/model/units.h"

namespace ehm::engine_sim {

struct Measurements {
  double n1_rpm, n2_rpm;
  double t48_k;
  double ps_30_pa;
  double t2_k, p2_pa;
  bool on_ground = false;  ///< weight on wheels, ratings.h

  double theta2() const { return t2_k / reference_temperature_k; }
  double delta2() const { return p2_pa / reference_pressure_pa; }
  double n1_corrected_rpm() const { return n1_rpm / std::sqrt(theta2()); }
  double n2_corrected_rpm() const { return n2_rpm / std::sqrt(theta2()); }
};

/// Wf of one ratio unit: kg/s for Wf/(Ps30 theta2^m) = 1 kg/s per MPa.
inline double fuel_per_ratio_unit(const Measurements& m, double theta_exponent) {
  return 1e-6 * m.ps_30_pa * std::pow(m.theta2(), theta_exponent);
}

inline Measurements measure(const GasPath& gas, bool on_ground = false) {
  return {gas.speeds.n1_rpm, gas.speeds.n2_rpm, gas.s48.tt_k, gas.ps_30_pa, gas.s2.tt_k, gas.s2.pt_pa, on_ground};
}

}  // namespace ehm::engine_sim
