// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sets of sigma points: mean 0, covariance I in d dimensions, from which x + S chi has mean x and covariance S S'.
//   symmetric          2 d + 1   W0 = k/(d + k), the others 1/(2 (d + k)); chi = +-sqrt(d + k) e_i
//   spherical simplex  d + 2     W0 in [0, 1), W1 = (1 - W0)/(d + 1); chi_1, chi_2 = -+1/sqrt(2 W1); dimension j
//                                appends -1/sqrt(j (j + 1) W1) to chi_1..chi_j, and chi_(j+1) = [0; j/sqrt(j (j + 1) W1)]
//   minimal skew       d + 2     W1 = W2 = (1 - W0)/2^d, Wi = 2^(i-2) W1; dimension j appends -1/sqrt(2 W_(j+1)) to
//                                chi_1..chi_j, and chi_(j+1) = [0; 1/sqrt(2 W_(j+1))]
// and each of them scaled to a small neighbourhood:
//   chi' = a chi,  Wi' = Wi/a^2,  W0' = W0/a^2 + 1 - 1/a^2,  W0c' = W0' + 1 - a^2 + b
// b = 2 suits Gaussians. A simplex has hardly more points than states; the minimal skew one reaches as far as 2^(d/2),
// so that it needs a small a. Shapes: points d x count, weights count; the first point is the centre.
// Source: Julier 2002 (scaled), 2003 (spherical), Julier & Uhlmann 2002 (minimal skew); in [E] the spherical set has 1
// where j stands here, and then its mean is not 0.
// @throws std::invalid_argument unless d >= 1, 0 <= W0 < 1, d + k > 0, a > 0.

#include <Eigen/Core>
#include <array>
#include <string_view>

namespace ehm::nonlinear {

enum class SigmaSet { symmetric, spherical_simplex, minimal_skew };
inline constexpr std::array<std::string_view, 3> sigma_set_names{"symmetric", "spherical_simplex", "minimal_skew"};

struct SigmaPoints {
  Eigen::MatrixXd points;
  Eigen::VectorXd mean_weights, covariance_weights;
};

struct SigmaOptions {
  SigmaSet set = SigmaSet::symmetric;
  double kappa = 0.0;          ///< k, of the symmetric set
  double centre_weight = 0.0;  ///< W0, of the simplexes
  /// a: 0 takes that which puts the farthest point at sqrt(3), where a Gaussian's fourth moment is right.
  double alpha = 0.0;
  double beta = 2.0;  ///< b
};

SigmaPoints sigma_points(Eigen::Index dimension, const SigmaOptions& options);

}  // namespace ehm::nonlinear
