// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tangent of the nonlinear engine at a steady point (Endurthi thesis ch. 4, perturbation method):
//   central    df/dv_j = ( f(v + s e_j) - f(v - s e_j) ) / 2 s
//   forward    df/dv_j = (-3 f(v) + 4 f(v + s e_j) - f(v + 2 s e_j)) / 2 s     where an input cannot be less (bleed
//              valves that are shut), of second order too
// The step is relative to trim for speeds and fuel, absolute for health, one for all columns: the truncation error
// falls with s^2, the round-off error of the flow balance grows with 1/s, and the study takes the s between whose
// neighbours the scaled derivatives change least.

#include <vector>

#include "tuner_design/linearise/plant.h"

namespace ehm::tuner_design {

/// One step of the study.
struct StepStudyRow {
  double step = 0.0;
  double change = 0.0;  ///< largest relative change of a scaled column to the next smaller step
};

struct StepStudy {
  Eigen::MatrixXd jacobian;  ///< df/dv at the chosen step
  double step = 0.0;
  std::vector<StepStudyRow> rows;
};

/// Steps from 1e-2 down by half decades.
/// @throws std::runtime_error if no step gives derivatives that agree to 1e-3 with its neighbour's.
StepStudy study_steps(const Plant& plant);

}  // namespace ehm::tuner_design
