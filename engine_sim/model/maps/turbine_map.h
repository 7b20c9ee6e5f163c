// SPDX-License-Identifier: Apache-2.0
#pragma once
// One turbine map in its own (unscaled) coordinates: Np = speed parameter, percent of design; PR = expansion ratio.
//   Wp(Np, PR) = sqrt(1 - exp(-k (PR - 1))) g(Np, PR)   flow parameter w sqrt(T)/p, lbm/s sqrt(R)/psia
//   eff(Np, PR)                                          isentropic efficiency
// g and eff are tensor-product cubic B-splines (spline.h), continued linearly. The root makes the flow vanish at PR = 1
// and choke at high PR, which the tables (PR >= 3) leave to the user of the map. Source of the root: the flow of a
// nozzle, in the form of the reference data's README ("map forms that were tried").

#include <span>

#include "engine_sim/model/maps/map_numbers.h"
#include "engine_sim/model/maps/spline.h"
#include "engine_sim/model/solve/dual.h"

namespace ehm::engine_sim {

/// The fitted numbers of one map; surfaces are row-major, one row per speed basis function.
struct TurbineMapData {
  double choking_rate;  ///< k
  std::span<const double> speed_breaks;
  std::span<const double> pressure_ratio_breaks;
  std::span<const double> flow;
  std::span<const double> efficiency;
};

template <class S>
struct TurbineMapPoint {
  S flow;
  S efficiency;
};

class TurbineMap {
 public:
  /// Copies the numbers.
  /// @throws std::invalid_argument if a surface does not have the size that its break points ask for
  explicit TurbineMap(const TurbineMapData& data);

  /// Real-time safe: yes.
  template <class S>
  TurbineMapPoint<S> at(const S& speed, const S& pressure_ratio) const {
    using std::exp, std::sqrt;
    const BasisValues n = speed_.at(value(speed));
    const BasisValues p = pressure_ratio_.at(value(pressure_ratio));
    const SurfaceValue g = surface(n, p, data_.flow, pressure_ratio_.size());
    const SurfaceValue eff = surface(n, p, data_.efficiency, pressure_ratio_.size());
    const S choking = sqrt(1.0 - exp(-data_.choking_rate * (pressure_ratio - 1.0)));
    return {choking * chain(g.f, g.by_x, speed, g.by_y, pressure_ratio),
            chain(eff.f, eff.by_x, speed, eff.by_y, pressure_ratio)};
  }
  const TurbineMapData& data() const { return data_; }

 private:
  TurbineMapData data_;
  MapNumbers numbers_;
  SplineBasis speed_;
  SplineBasis pressure_ratio_;
};

}  // namespace ehm::engine_sim
