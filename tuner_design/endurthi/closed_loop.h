// SPDX-License-Identifier: Apache-2.0
#pragma once
// The nonlinear engine in its closed loop, recorded: what acted on it and what its sensors would have read.
//   u(k) acts from sample k to k + 1 and is in y(k); deviations from the point's trim, channel units
// The spools are integrated by Heun's method at the record's step. Health is constant and the engine begins at the given
// states, with the control set for trim: the loop moves the fuel, the control's vanes follow N2 with their own lag, the
// nozzle stays. Shapes: u nu x samples, y m x samples. Errors: those of ControlledEngine.

#include "tuner_design/endurthi/study_engine.h"

namespace ehm::tuner_design::endurthi {

struct Record {
  double step_s = 0.0;
  Eigen::VectorXd x0, h;  ///< n, p, deviations
  Eigen::MatrixXd u, y;
};

/// `states`, `health`: deviations from trim.
Record closed_loop(const StudyPoint& point, const Eigen::VectorXd& states, const Eigen::VectorXd& health,
                   double seconds, double step_s);

}  // namespace ehm::tuner_design::endurthi
