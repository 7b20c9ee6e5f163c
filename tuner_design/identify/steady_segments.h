// SPDX-License-Identifier: Apache-2.0
#pragma once
// Which samples of a recording a linear model may be compared with: unbroken, at its point, and not on the way to
// another one.
//
//   missing    a sensor that is used, an actuator or the flight condition has no value. A sensor with less than 90 % of
//              its values is not used at all
//   off point  farther from the model's point than one tolerance (estimation/point_distance.h)
//   moving     the record is looked at in windows of twice the slowest time constant of A, 64 to 512 samples. Where the
//              mean flight condition or actuator of a window lies more than a tenth of a tolerance from that of the one
//              before, both are moving, and so are five slowest time constants after them, in which the engine settles.
//              Sensors are not asked, so that an engine whose health walks is not left out for that
//   drift      a window farther than a tenth of a tolerance from the first of its piece: the record is cut there
//   jump       |y[k] - y[k-1]| above 8 times the usual, 1.4826 times the median: a bias, a spike, a sensor that comes
//              back. The record is cut there
//   short      what is left in pieces of fewer samples than 12 slowest time constants, 512 to 4096
//
// A cut costs no sample. Errors: none; a recording without such samples has no segments.

#include <vector>

#include "engine_sim/linear_model/linear_model.h"
#include "monitor/data/options.h"
#include "tuner_design/identify/recorded_samples.h"

namespace ehm::tuner_design {

struct SteadySelection {
  std::vector<int> sensors;    ///< that are used, ascending
  std::vector<Span> segments;  ///< in the order of the recording
  Eigen::Index recorded = 0, used = 0, missing = 0, off_point = 0, moving = 0, too_short = 0;  ///< samples
  Eigen::Index gaps = 0, jumps = 0, drifts = 0;                                                ///< cuts
  Eigen::Index window = 0, settling = 0, least_length = 0;                                     ///< samples
};

/// `model` discrete, channel units, with the record's channels.
SteadySelection select_steady(const RecordedSamples& record, const linear_model::LinearModel& model,
                              const monitor::ValidityOptions& validity);

}  // namespace ehm::tuner_design
