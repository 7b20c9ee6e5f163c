// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the model of independent, white sensor noise leaves out, by one Newton step from the fit (the score test of Rao,
// Proc. Cambridge Phil. Soc. 44 (1948) 50): what would one more variance phi with the spectrum S_phi be?
//
//   phi = s / I,   s = share sum_b n_b tr(S^-1 S_phi S^-1 (P - S)),   I = F_pp - F_pt F_tt^-1 F_tp,   sigma = I^-1/2
//
//   correlation  of the noises of sensors i and j   S_phi = the shape of their noise at (i, j) and (j, i), told as
//                                                   phi / sqrt(R_i R_j)
//   colour       of the noise of sensor i           S_phi = 2 cos(w) times its shape at (i, i); phi / R_i is the
//                                                   correlation of one sample with the next
//
// and how well the fit covers the spectrum: of each sensor and range of frequencies, measured over modelled power.
// Errors: none.

#include <vector>

#include "tuner_design/identify/whittle_fit.h"

namespace ehm::tuner_design {

struct NoiseCheck {
  int sensor = 0, other = 0;  ///< among the sensors of the fit; other == sensor: colour
  double correlation = 0.0, standard_error = 0.0;
};

/// All pairs, then all colours. The groups 0 .. m-1 of the fit are the sensors' noises.
std::vector<NoiseCheck> noise_checks(const std::vector<SpectralBand>& bands, const NoiseGroups& groups,
                                     const WhittleFit& fit);

struct PowerRatio {
  Eigen::VectorXd ratio;  ///< by sensor, measured over modelled
  double standard_error = 0.0;
};

/// Over the bands with low <= omega < high; without any the ratio is empty.
PowerRatio power_ratio(const std::vector<SpectralBand>& bands, const NoiseGroups& groups, const WhittleFit& fit,
                       double low, double high);

}  // namespace ehm::tuner_design
