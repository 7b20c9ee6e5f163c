// SPDX-License-Identifier: Apache-2.0
#pragma once
// Theoretical error of the steady-state filter on the tuners, over the fleet (theory.md, section 4; [SG] leaves it as
// future work). Acl = Axq - Kinf Cxq Axq, Th = [0, Rh], Tz = [F, Rz] with Rh = W, Rz = N W, or those of read_out.h for a
// model that knows its linearisation error; unknowns e with h = Gh e, steady sensors Gy e, z = Gz e
// (design::FleetUnknowns, the first p of them health):
//   mean      E[xhat] = X e,  X = (I - Acl)^-1 Kinf Gy
//   variance  S = Acl S Acl^T + Kinf R Kinf^T + (I - Kinf Cxq) Qw (I - Kinf Cxq)^T,   Qw = blkdiag(Q, 0)
//             of the error xhat - [x; q] about its mean: the engine's states are driven by w of the model's
//             covariance Q, its health is constant within a run (Qh is a knob of speed, not a belief)
//   bias      B = T X - (Gh or Gz)
//   total     B B^T + T S T^T; of it linearisation: the columns of B beyond the first p, squared
//             filter's own   T P+ T^T, P+ = (I-KC) P (I-KC)^T + K R K^T (Joseph)
// Innovation variance: diag(C P C^T + R); for a sensor that is not used the fleet's bias of
// health is added, with T = Cxq and Gy. Slowest time constant: -T_sample / ln(spectral radius of Acl), in seconds.

#include "monitor/design/design.h"
#include "monitor/estimation/steady_gain.h"

namespace ehm::tuner_design {

/// Fills the read-out where the model knows its linearisation error, the covariances, innovation_variance and slowest_time_constant_s of a design made by kalman_gain.
/// `model` is discrete and scaled, `steady` its steady gain.
/// @throws SolverError if the closed loop is not stable or a variance comes out negative.
void add_error_theory(design::SubsetDesign& design, const linear_model::LinearModel& model,
                      const estimation::SteadyGain& steady);

}  // namespace ehm::tuner_design
