// SPDX-License-Identifier: Apache-2.0
#pragma once
// What an estimator says of one engine after a sample. Absolute values in channel units; the two standard deviations of
// a channel: that of the whole error over the fleet, which is published as sigma_total, and the estimator's own idea,
// which is blind to what its model leaves out. Plain data of fixed capacity: a copy allocates nothing.

#include "monitor/estimation/capacity.h"

namespace ehm::estimation {

struct Estimate {
  HealthVector health, health_sigma, health_sigma_filter;
  AuxiliaryVector auxiliary, auxiliary_sigma, auxiliary_sigma_filter;
  TunerVector tuners;  ///< q, percent of health; of length 0 where the estimator has none
  SensorMask sensors;  ///< that it uses at present
  bool holds = true;   ///< false: the estimator had no answer to this sample, and what stands here is older
  /// The health parameter that has most likely stepped and is being learned anew, how much of it was seen when it was
  /// found, and the least that would have been seen; channel units. -1: none has.
  int stepped = -1;
  double step = 0.0, least_step = 0.0;
  /// The sensor that has most likely become biased, by how much, and the least that would have been seen; its unit.
  /// -1: none.
  int biased = -1;
  double bias = 0.0, least_bias = 0.0;
  /// A sensor that may have become biased, by `bias`, though a health parameter that has stepped would explain it nearly
  /// as well: nobody can name it. -1: none.
  int suspected = -1;
  bool settled = false;  ///< what it did not know at its start has faded to a thousandth
};

}  // namespace ehm::estimation
