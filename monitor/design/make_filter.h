// SPDX-License-Identifier: Apache-2.0
#pragma once
// From a design (scaled units) to the filter that flies (channel units). With s_x, s_h, s_y, s_z the scales:
//   C_phys = s_y C, K_phys = K s_y^-1, Th = s_h [0, W], Tz = s_z [F, N W].
// Re-reference between sensor sets a -> b, H_b the rows of H for the sensors of b:
//   T = (H_b W_b)^+ H_b W_a, q_b = T q_a, x_b = x_a + (I-A)^-1 L (W_b T - W_a) q_a,
// which leaves the predicted sensors of b as they were, in this sample and in all later ones. Where b has fewer tuners
// than sensors they are kept in the least-squares sense, weighted by the noise.

#include "monitor/design/design.h"
#include "monitor/estimation/tuner_filter.h"

namespace ehm::design {

/// @throws std::invalid_argument if the design's matrices do not fit together.
estimation::TunerFilter make_filter(const Design& design);

}  // namespace ehm::design
