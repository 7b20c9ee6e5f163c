// SPDX-License-Identifier: Apache-2.0
#pragma once
// Exact zero-order hold: health and actuators constant over one sample.
//   exp( [A B L; 0 0 0; 0 0 0] T ) = [Ad Bd Ld; 0 I 0; 0 0 I]
// A n x n in 1/s, B n x nu, L n x p, T in s. C, D, M, F, G, N and the process noise (already per sample) stay.
// Source: Van Loan, IEEE TAC 23 (1978) 395; Endurthi thesis ch. 4 for the use on engines.

#include "engine_sim/linear_model/linear_model.h"

namespace ehm::linear_model {

/// A discrete model is returned as it is. @throws std::runtime_error if the exponential is not finite.
LinearModel discretise(const LinearModel& model);

}  // namespace ehm::linear_model
