// SPDX-License-Identifier: Apache-2.0
#pragma once
// Links lose a sample now and then, and to cut the record at each would leave no piece long enough. Up to three values
// in a row that a sensor lacks are put on the straight line between their neighbours, an actuator's and the flight
// condition's are those before. Only of a channel that lacks 2 % of its values at most: a mended value has half the
// noise of a measured one, so that a variance comes out as much too small, at most, as values are mended.
// Errors: none.

#include "tuner_design/identify/recorded_samples.h"

namespace ehm::tuner_design {

/// @returns samples in which something was mended.
Eigen::Index mend_short_holes(RecordedSamples& record);

}  // namespace ehm::tuner_design
