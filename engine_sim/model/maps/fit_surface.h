#pragma once
// Least-squares fit of a tensor-product cubic B-spline to a table z(x_i, y_j) with weights w_ij:
//   minimise sum w_ij^2 (sum_kl c_kl b_k(x_i) b_l(y_j) - z_ij)^2 + smoothing * (sum of squared third differences of c)
// The third differences, in both directions, let a quadratic pass unpunished; they fill regions of zero weight and keep
// the surface from wiggling between samples. Solved by column-pivoted QR of the stacked system, never by normal
// equations. Shapes: rows of z belong to x, columns to y; the result is row-major with one row per x basis function.
// Source: Eilers & Marx, Flexible smoothing with B-splines and penalties, Statistical Science 11 (1996), equation 4.

#include <Eigen/Core>
#include <span>
#include <vector>

namespace ehm::engine {

/// @throws std::invalid_argument if the shapes of x, y, z and weight do not belong together
/// @throws std::runtime_error if the stacked system is rank deficient (too many break points for the samples)
std::vector<double> fit_surface(std::span<const double> x, std::span<const double> y, const Eigen::MatrixXd& z,
                                const Eigen::MatrixXd& weight, std::span<const double> x_breaks,
                                std::span<const double> y_breaks, double smoothing);

/// The same in one dimension: z(x_i), all weights one. @throws as above
std::vector<double> fit_curve(std::span<const double> x, std::span<const double> z, std::span<const double> breaks,
                              double smoothing);

}  // namespace ehm::engine
