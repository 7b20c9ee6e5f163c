// SPDX-License-Identifier: Apache-2.0
#pragma once
// Theoretical error of the steady-state filter on the tuners, over the fleet (theory.md, section 4; [SG] leaves it as
// future work). Acl = Axq - Kinf Cxq Axq, Th = [0, W], Tz = [F, N W]:
//   mean      E[xhat] = (I - Acl)^-1 Kinf H h
//   variance  S = Acl S Acl^T + Kinf R Kinf^T + (I - Kinf Cxq) Qw (I - Kinf Cxq)^T,   Qw = blkdiag(Q, 0)
//             of the error xhat - [x; q] about its mean: the engine's states are driven by w of the model's
//             covariance Q, its health is constant within a run (Qh is a knob of speed, not a belief)
//   bias      G = T (I - Acl)^-1 Kinf H - (I or Hz)
//   offset    O = T (I - Acl)^-1 Kinf                    answer to a constant sensor offset
//   linearisation  [O, -e] Lambda [O, -e]^T              Lambda = linearisation_error of [y; z], e = 0 for h, I for z
//   total     G Ph G^T + T S T^T + linearisation
//             filter's own   T P+ T^T, P+ = (I-KC) P (I-KC)^T + K R K^T (Joseph)
// Innovation variance: diag(C P C^T + R); for a sensor that is not used the fleet's bias G_y Ph G_y^T is added, with
// T_y = Cxq and H in place of Hz. Slowest time constant: -T_sample / ln(spectral radius of Acl), in seconds.

#include "monitor/design/design.h"
#include "monitor/estimation/steady_gain.h"

namespace ehm::tuner_design {

/// Fills the covariances, innovation_variance and slowest_time_constant_s of a design made by kalman_gain.
/// `model` is discrete and scaled, `steady` its steady gain.
/// @throws SolverError if the closed loop is not stable or a variance comes out negative.
void add_error_theory(design::SubsetDesign& design, const linear_model::LinearModel& model,
                      const estimation::SteadyGain& steady);

}  // namespace ehm::tuner_design
