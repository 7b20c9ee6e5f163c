// SPDX-License-Identifier: Apache-2.0
#pragma once
// How far a linear model goes from the nonlinear engine on the same controls (Endurthi thesis, section 5.1, read so that
// its numbers fit; the thesis does not give the norm):
//   dx[k+1] = Ad dx + Bd u + Ld h,  dy = C dx + D u + M h      u the record's own, exact zero-order hold
//   e(k) = RMS over sensors of ( dy - y ) in percent of trim, over the percent of the perturbation under test
//   average = mean of e over the record,  final = e of its last sample
// The linear engine begins where the nonlinear one does. No units: a relative error per relative perturbation.

#include "tuner_design/endurthi/closed_loop.h"

namespace ehm::tuner_design::endurthi {

struct ModelError {
  double average = 0.0, final = 0.0;
};

/// The linear engine's sensors on the record's controls less the record's, m x samples, channel units.
Eigen::MatrixXd missed_by(const Plant& plant, const Eigen::MatrixXd& jacobian, const Record& record);

ModelError error_of(const Plant& plant, const Eigen::MatrixXd& jacobian, const Record& record, double percent);

/// A plant whose maps have a corner close to trim, as tables have that are interpolated linearly: health beyond
/// `corner` (below zero) acts `steeper` times as much more. Open loop.
Plant with_corner(const Plant& plant, double corner, double steeper);

/// The plant's answer to states and health, controls at trim, by the classical Runge-Kutta method.
Record open_loop(const Plant& plant, const Eigen::VectorXd& states, const Eigen::VectorXd& health, double seconds,
                 double step_s);

}  // namespace ehm::tuner_design::endurthi
