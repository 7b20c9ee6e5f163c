// SPDX-License-Identifier: Apache-2.0
#pragma once
// A lower bound of J for every set of sensors at once: J of the Bayes limit of that set, which no filter on it beats.
//   C0(S) = Ph - Ph H_S^T (H_S Ph H_S^T)^-1 H_S Ph = Ph^1/2 (I - Q Q^T) Ph^1/2,  Q orthonormal basis of Ph^1/2 H_S^T
//   J(S) >= sum_i wh C0_ii + sum_j wz_j (Hz C0 Hz^T)_jj
// Each further sensor adds at most one column to Q (Gram and Schmidt), so that the 2^n bounds cost a depth-first walk
// with some p |S| operations a set. A larger set has a smaller bound: the bound of all sensors still possible also
// bounds every set that leaves some of them out. Source: theory.md, section 5.

#include <vector>

#include "tuner_design/sensors/sensor_set.h"

namespace ehm::tuner_design {

/// [S] is the bound of the set S; [0] is J of the fleet itself, without any sensor.
std::vector<double> subset_bounds(const SensorProblem& problem);

}  // namespace ehm::tuner_design
