// SPDX-License-Identifier: Apache-2.0
#pragma once
// Innovation gate with a chi-square meaning: ratio_i = nu_i^2 / (gate^2 S_ii), closed above 1. With gate = 5 a healthy
// value of one degree of freedom exceeds it once in 1.7 million.
//
// One sensor alone outside: that sensor is suspect, and is not fused. Two or more outside at once, or one while the
// others together are restless (sum of nu_j^2 / S_jj over the m - 1 others above its mean by four standard deviations
// of a chi-square): the engine changed, not the sensors, and all are fused; rejecting them would freeze the filter away
// from the truth for good. Real-time safe: yes.

#include <cstdint>

#include "monitor/estimation/capacity.h"

namespace ehm::monitor {

struct GateDecision {
  estimation::SensorVector ratio;   ///< of every sensor; NaN where there is no innovation
  estimation::SensorMask rejected;  ///< by the gate
};

/// `offered`: sensors that passed the checks and are in the design that flies.
GateDecision innovation_gate(const estimation::SensorVector& innovation, const estimation::SensorVector& variance,
                             estimation::SensorMask offered, double gate_sigma) noexcept;

}  // namespace ehm::monitor
