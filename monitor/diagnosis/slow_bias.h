// SPDX-License-Identifier: Apache-2.0
#pragma once
// A sensor that drifts away slowly, where that can be told from wear at all. The filter follows a slow bias as if it
// were health; so what counts is where the steady sensors that it believes in have come to stand:
//
//   ys  = H W q                               m, scaled, deviations from the design's trim
//   Sy  = H Ph H^T + Lambda_yy + H Sh H^T     spread over the fleet, its nonlinearity, the filter's noise
//   z_i = [Sy^-1 ys]_i / sqrt([Sy^-1]_ii)     a standard normal deviate while sensor i is well;
//   b_i = [Sy^-1 ys]_i / [Sy^-1]_ii           the most likely bias, if only sensor i is biased
//
// Raised for sensor i, after five seconds in a row, when |z_i| exceeds the quantile of slow_bias_probability (per
// engine, not per hour: the fleet is drawn once), without the bias the rest is an ordinary engine (ys^T Sy^-1 ys -
// z_i^2 below the chi-square quantile of 0.999), and no other sensor comes near (|z_j| below 0.8 |z_i|). Cleared below
// 0.7 of the threshold. Only sensors whose detectability exceeds 5 are watched (monitor/design/detectability.h). It is
// advice: the sensor stays in use, since the fleet's spread is an assumption. Only with the full sensor set. Real-time
// safe: yes, after construction.
//
// A drift that ends, by a repair or a connector, looks like an abrupt bias of its negative. Which of the two a step of
// b is, is told by what it makes of the engine: with s = b / b_i z_i the distance ys^T Sy^-1 ys falls by
//   g = -2 z_i s - s^2
// if the step ends a drift. More than 2 ln(1 / wrong_name_probability) is the end of one: then |z_i| > sqrt(g), and one
// engine of the fleet in 10 000 stands there by wear.

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "deploy/runtime/numbers/index.h"
#include "monitor/data/events.h"
#include "monitor/data/options.h"
#include "monitor/design/design.h"
#include "monitor/estimation/capacity.h"

namespace ehm::monitor {

/// Constants of one design.
struct SlowBiasTable {
  estimation::BoundedMatrix<estimation::max_sensors, estimation::max_tuners> whitened;  ///< D^-1/2 Sy^-1 H W: z = . q
  estimation::BoundedMatrix<estimation::max_tuners, estimation::max_tuners> distance;   ///< W^T H^T Sy^-1 H W
  estimation::SensorVector bias_per_z;                                                  ///< sensor units
  estimation::SensorMask watched;
  double ordinary = 0.0;  ///< quantile of the distance without the bias
  std::int64_t persistence_samples = 0;
};

/// What the detectors of all engines of one design share.
std::shared_ptr<const SlowBiasTable> slow_bias_table(const design::Design& design);

class SlowBias {
 public:
  SlowBias(const FaultOptions& options, std::shared_ptr<const SlowBiasTable> table);

  /// `tuners` of the full sensor set, converged.
  void check(const estimation::TunerVector& tuners, EventList& events) noexcept;
  /// Takes back what is raised: the filter starts anew.
  void reset(EventList& events) noexcept;
  /// Does a step of `size` (sensor units) of a sensor end a drift that the filter has followed?
  bool ended_by(int sensor, double size) const noexcept;
  /// A drift of any sensor is raised.
  bool raised() const noexcept;
  bool watches(int sensor) const noexcept { return table_->watched[as_size(sensor)]; }

 private:
  bool drifted(int sensor, double distance2) const noexcept;

  std::shared_ptr<const SlowBiasTable> table_;
  double threshold_, least_gain_;
  estimation::SensorVector z_;
  std::array<std::int64_t, estimation::max_sensors> above_{};
  std::vector<Condition> conditions_;
};

}  // namespace ehm::monitor
