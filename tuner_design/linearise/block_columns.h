// SPDX-License-Identifier: Apache-2.0
#pragma once
// Three ways to the columns of a linear model, each for the block of the states, of the controls or of health by itself
// (Endurthi thesis ch. 4; theory.md, section 9). f = [dx/dt; y] of plant.h, s the step of input j:
//   0 perturbation   df/dv_j = ( f(v0 + s e_j) - f(v0) ) / s at t = 0, or central; s relative to the input's size
//   1 linmod         the same, one-sided, at the tiny step s = 1e-5 (1 + 1e-3 |v_j|) of Matlab's linmod
//   2 steady state   states: [A; C] = [dF1 .. dFn] [dX1 .. dXn]^-1, dXi and dFi what is left of a step of state i after a
//                    short time, open loop
//                    controls, health: [B; D] = ( dFss - [A; C] dXss ) / s from the open-loop steady state after a step
//                    of each. With whatever A and C, the model's steady response to that step is then the plant's
// Tiny steps cost digits and see one side of a corner of a map; long ones average over it. On smooth maps 0 and 1 tend
// to the tangent (step_study.h); 2 tends to the secant of steady y. Shapes: [A; C] outputs x n, [B; D] outputs x inputs
// of the block. Errors: those of the plant and of settled() (open_loop.h).

#include "tuner_design/linearise/plant.h"

namespace ehm::tuner_design {

/// In the thesis' numbers.
enum class ColumnMethod { perturbation, linmod, steady_state };

struct ColumnSteps {
  double relative = 1e-3;    ///< of each input's size; its sign is the side of a one-sided difference
  bool central = false;      ///< method 0: both sides, where the input may be less
  double response_s = 0.02;  ///< method 2: after which the response to a step of a state is taken
};

/// [A; C]
Eigen::MatrixXd state_columns(const Plant& plant, ColumnMethod method, const ColumnSteps& steps);

/// [B; D] of the controls, [L; M] of health; `states`: the model's [A; C].
Eigen::MatrixXd control_columns(const Plant& plant, ColumnMethod method, const ColumnSteps& steps,
                                const Eigen::MatrixXd& states);
Eigen::MatrixXd health_columns(const Plant& plant, ColumnMethod method, const ColumnSteps& steps,
                               const Eigen::MatrixXd& states);

}  // namespace ehm::tuner_design
