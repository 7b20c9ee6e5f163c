// SPDX-License-Identifier: Apache-2.0
#pragma once
// Variances from spectra: the greatest likelihood of measured band means P_b under
// S_b = sum_g theta_g S_bg, theta >= 0.
//
//   deviance   2 share sum_b n_b (ln det S_b + tr S_b^-1 P_b)            n_b bins, share: independent_share
//   F_gh  = share sum_b n_b tr(S_b^-1 S_bg S_b^-1 S_bh)                  Fisher's information
//   b_g   = share sum_b n_b tr(S_b^-1 S_bg S_b^-1 P_b)
//   theta = least of 1/2 theta^T F theta - b^T theta over theta >= 0     with the weights S_b of the last theta, until
//                                                                        nothing moves; half steps where it got worse
//
// That is covariance matching by least squares, linear in the variances, weighted by the covariance of what is matched:
// the autocovariance least squares of Odelson, Rajamani & Rawlings (Automatica 42 (2006) 303) after a Fourier
// transform, in which the weight, there a matrix of the fourth moments of all lags that is too large to build, falls
// apart into one small matrix a frequency. The optimum is Whittle's estimate (Ark. Mat. 2 (1953) 423), which no other
// estimate of a Gaussian process beats in the long run. cov(theta) = F^-1.
// Errors: none; every sensor's own noise must have a group, so that S_b is positive definite.

#include <vector>

#include "tuner_design/identify/spectral_bands.h"

namespace ehm::tuner_design {

/// Terms of NoiseSpectra that share one variance.
using NoiseGroups = std::vector<std::vector<std::size_t>>;

/// S_bg: the spectra of a group's terms together.
Eigen::MatrixXcd group_spectrum(const SpectralBand& band, const std::vector<std::size_t>& group);
/// S_b
Eigen::MatrixXcd spectrum(const SpectralBand& band, const NoiseGroups& groups, const Eigen::VectorXd& theta);

struct WhittleFit {
  Eigen::VectorXd theta;           ///< variances, by group
  Eigen::VectorXd standard_error;  ///< with all others free, those at 0 too: what cannot be told apart has a large one
  Eigen::MatrixXd information;     ///< F at theta
  Eigen::VectorXd right;           ///< b at theta
  Eigen::MatrixXd covariance;      ///< F^-1 over those above 0; rows of those at 0 are 0
  double deviance = 0.0;
  int iterations = 0;
};

/// From `start`, all above 0.
WhittleFit whittle_fit(const std::vector<SpectralBand>& bands, const NoiseGroups& groups, const Eigen::VectorXd& start);

/// The largest value of one variance that is within so many standard deviations of the fit, where the others make room
/// for it as far as 0 lets them: 1/2 theta^T F theta - b^T theta has grown by sigmas^2 / 2, least over the others.
double upper_end(const WhittleFit& fit, Eigen::Index group, double sigmas);

}  // namespace ehm::tuner_design
