// SPDX-License-Identifier: Apache-2.0
#pragma once
// Least-squares fit of a tensor-product cubic B-spline to a table z(x_i, y_j) with weights w_ij:
//   minimise sum w_ij^2 (f(x_i, y_j) - z_ij)^2 + smoothing * (sum of squared third differences of c)
//            + weight^2 * mean over the points p of a path of ((f(p - s) - 2 f(p) + f(p + s))/|s_y|^2)^2,
//   f(x, y) = sum_kl c_kl b_k(x) b_l(y)
// The third differences, in both directions, let a quadratic pass unpunished; they fill regions of zero weight and keep
// the surface from wiggling between samples. Solved by column-pivoted QR of the stacked system, never by normal
// equations. The path keeps the surface straight along one direction s where its slopes must hold over a distance.
// Shapes: rows of z belong to x, columns to y; the result is row-major with one row per x basis function. Source:
// Eilers & Marx, Flexible smoothing with B-splines and penalties, Statistical Science 11 (1996), equation 4.

#include <Eigen/Core>
#include <span>
#include <utility>
#include <vector>

namespace ehm::engine_sim {

/// Points where, and the step (of x, of y) along which, the second difference of the surface is punished.
struct StraightPath {
  std::vector<std::pair<double, double>> points;
  double step_x = 0.0, step_y = 1.0;
  double weight = 0.0;
};

/// Smoothing for surfaces of order one, as maps are fitted: it only decides where samples do not.
inline constexpr double map_smoothing = 1e-6;

/// @throws std::invalid_argument if the shapes of x, y, z and weight do not belong together
/// @throws std::runtime_error if the stacked system is rank deficient (too many break points for the samples) or its
///         solution is not finite
std::vector<double> fit_surface(std::span<const double> x, std::span<const double> y, const Eigen::MatrixXd& z,
                                const Eigen::MatrixXd& weight, std::span<const double> x_breaks,
                                std::span<const double> y_breaks, double smoothing, const StraightPath& path = {});

/// The same in one dimension: z(x_i), all weights one. @throws as above
std::vector<double> fit_curve(std::span<const double> x, std::span<const double> z, std::span<const double> breaks,
                              double smoothing);

}  // namespace ehm::engine_sim
