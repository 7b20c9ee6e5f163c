// SPDX-License-Identifier: Apache-2.0
#pragma once
// One compressor map in its own (unscaled) coordinates: n = corrected speed / design, R = R-line (1 is surge).
//   Wc(n, R) = n^a phi(n, R)            corrected flow, lbm/s at 518.67 R and 14.696 psia
//   PR(n, R) = 1 + n^b exp(psi(n, R))   pressure ratio, above 1 everywhere
//   eff(n, R)                           isentropic efficiency; below 0.2 it decays to 0.05 (deep choke)
//   PRsurge(Wc)                         the line R = 1, for stall margins at constant corrected flow
//   choke(R) = exp(-c (R - Rend)^2)      total pressure kept beyond the table's last R-line Rend, 1 before it
// phi, psi and eff are tensor-product cubic B-splines (spline.h). The powers a and b carry the similarity law of the
// low speeds, so that the continuation below the lowest speed line stays physical: no flow and no rise at rest. A
// choked compressor passes no more flow however low its back pressure: what is left over is lost in shocks, so its exit
// pressure may fall below its inlet's while it still absorbs work. Source of the form: the fan laws (Wc ~ n, PR - 1 ~
// n^2) with exponents of each map's lowest speed lines.

#include <span>

#include "engine_sim/model/maps/map_numbers.h"
#include "engine_sim/model/maps/spline.h"
#include "engine_sim/model/solve/dual.h"

namespace ehm::engine_sim {

/// The fitted numbers of one map; surfaces are row-major, one row per speed basis function.
struct CompressorMapData {
  double flow_exponent;
  double pressure_exponent;
  std::span<const double> speed_breaks;
  std::span<const double> r_line_breaks;
  std::span<const double> flow;
  std::span<const double> pressure;
  std::span<const double> efficiency;
  std::span<const double> surge_flow_breaks;
  std::span<const double> surge_pressure_ratio;
  double last_r_line;  ///< of the table
};

template <class S>
struct CompressorMapPoint {
  S flow;
  S pressure_ratio;  ///< that the work is for
  S efficiency;
  S choke;  ///< exit pressure is this times what the pressure ratio gives
};

class CompressorMap {
 public:
  /// Copies the numbers.
  /// @throws std::invalid_argument if a surface does not have the size that its break points ask for
  explicit CompressorMap(const CompressorMapData& data);

  /// Real-time safe: yes.
  template <class S>
  CompressorMapPoint<S> at(const S& speed, const S& r_line) const;
  template <class S>
  S surge_pressure_ratio(const S& flow) const;
  const CompressorMapData& data() const { return data_; }

 private:
  struct Values {
    SurfaceValue flow, pressure, efficiency;
  };
  Values values(double speed, double r_line) const;
  /// Surge line and its slope.
  struct SurgeValue {
    double pressure_ratio, by_flow;
  };
  SurgeValue surge(double flow) const;
  static constexpr double choke_rate = 0.5;

  CompressorMapData data_;
  MapNumbers numbers_;
  SplineBasis speed_;
  SplineBasis r_line_;
  SplineBasis surge_;
};

template <class S>
CompressorMapPoint<S> CompressorMap::at(const S& speed, const S& r_line) const {
  using std::exp, std::log;
  const Values m = values(value(speed), value(r_line));
  const auto surface_at = [&](const SurfaceValue& s) { return chain(s.f, s.by_x, speed, s.by_y, r_line); };
  const S log_speed = log(speed);
  return {exp(data_.flow_exponent * log_speed) * surface_at(m.flow),
          1.0 + exp(data_.pressure_exponent * log_speed + surface_at(m.pressure)), surface_at(m.efficiency),
          value(r_line) > data_.last_r_line
              ? S(exp(-choke_rate * (r_line - data_.last_r_line) * (r_line - data_.last_r_line)))
              : S(1.0)};
}

template <class S>
S CompressorMap::surge_pressure_ratio(const S& flow) const {
  const SurgeValue s = surge(value(flow));
  return chain(s.pressure_ratio, s.by_flow, flow);
}

}  // namespace ehm::engine_sim
