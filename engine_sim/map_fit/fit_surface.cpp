// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/map_fit/fit_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"
#include "engine_sim/model/maps/spline.h"

namespace ehm::engine_sim {
namespace {

using engine_sim::BasisValues;
using engine_sim::SplineBasis;

/// One row per sample, one column per basis function.
Eigen::MatrixXd design_matrix(const SplineBasis& basis, std::span<const double> samples) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(as_index(samples.size()), as_index(basis.size()));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const BasisValues at = basis.at(samples[i]);
    for (std::size_t k = 0; k < 4; ++k) {
      rows(as_index(i), as_index(at.first + k)) = at.b[k];
    }
  }
  return rows;
}

/// Rows (-1, 3, -3, 1) of the third difference.
Eigen::MatrixXd third_difference(Eigen::Index size) {
  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(std::max<Eigen::Index>(size - 3, 0), size);
  for (Eigen::Index i = 0; i < d.rows(); ++i) d.row(i).segment<4>(i) << -1.0, 3.0, -3.0, 1.0;
  return d;
}

/// Kronecker product, so that kron(A, B) acts on a row-major coefficient table.
Eigen::MatrixXd kron(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd out(a.rows() * b.rows(), a.cols() * b.cols());
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    for (Eigen::Index j = 0; j < a.cols(); ++j) {
      out.block(i * b.rows(), j * b.cols(), b.rows(), b.cols()) = a(i, j) * b;
    }
  }
  return out;
}

/// One row per point of the path: weighted second difference of the surface, for a row-major coefficient table.
Eigen::MatrixXd bending(const SplineBasis& x, const SplineBasis& y, const StraightPath& path) {
  const auto count = as_index(path.points.size());
  Eigen::MatrixXd rows(count, as_index(x.size() * y.size()));
  const double scale = path.weight / (path.step_y * path.step_y * std::sqrt(std::max(1.0, static_cast<double>(count))));
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto [at_x, at_y] = path.points[as_size(i)];
    const auto row = [&, px = at_x, py = at_y](double steps) {
      const std::array places{px + steps * path.step_x, py + steps * path.step_y};
      return kron(design_matrix(x, {&places[0], 1}), design_matrix(y, {&places[1], 1}));
    };
    rows.row(i) = scale * (row(-1.0) - 2.0 * row(0.0) + row(1.0));
  }
  return rows;
}

/// min |w (samples c - target)|^2 + |penalty c|^2
std::vector<double> solve(const Eigen::MatrixXd& samples, const Eigen::VectorXd& weight, const Eigen::VectorXd& target,
                          const Eigen::MatrixXd& penalty) {
  Eigen::MatrixXd stacked(samples.rows() + penalty.rows(), samples.cols());
  stacked << weight.asDiagonal() * samples, penalty;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(stacked.rows());
  right.head(target.size()) = weight.cwiseProduct(target);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(stacked);
  if (qr.rank() < stacked.cols()) {
    throw std::runtime_error("map fit: the least-squares system is rank deficient; use fewer break points");
  }
  const Eigen::VectorXd c = qr.solve(right);
  if (!c.allFinite()) throw std::runtime_error("map fit: the coefficients are not finite; check the tables' scale");
  return {c.begin(), c.end()};
}

}  // namespace

std::vector<double> fit_surface(std::span<const double> x, std::span<const double> y, const Eigen::MatrixXd& z,
                                const Eigen::MatrixXd& weight, std::span<const double> x_breaks,
                                std::span<const double> y_breaks, double smoothing, const StraightPath& path) {
  const auto nx = as_index(x.size()), ny = as_index(y.size());
  if (z.rows() != nx || z.cols() != ny || weight.rows() != nx || weight.cols() != ny) {
    throw std::invalid_argument("map fit: the table is not of the size of its coordinates");
  }
  const SplineBasis basis_x(x_breaks), basis_y(y_breaks);
  const Eigen::MatrixXd bx = design_matrix(basis_x, x), by = design_matrix(basis_y, y);
  const Eigen::MatrixXd along_x = kron(third_difference(bx.cols()), Eigen::MatrixXd::Identity(by.cols(), by.cols()));
  const Eigen::MatrixXd along_y = kron(Eigen::MatrixXd::Identity(bx.cols(), bx.cols()), third_difference(by.cols()));
  const Eigen::MatrixXd straight = bending(basis_x, basis_y, path);
  Eigen::MatrixXd penalty(along_x.rows() + along_y.rows() + straight.rows(), bx.cols() * by.cols());
  penalty << std::sqrt(smoothing) * along_x, std::sqrt(smoothing) * along_y, straight;
  return solve(kron(bx, by), weight.reshaped<Eigen::RowMajor>(), z.reshaped<Eigen::RowMajor>(), penalty);
}

std::vector<double> fit_curve(std::span<const double> x, std::span<const double> z, std::span<const double> breaks,
                              double smoothing) {
  const Eigen::MatrixXd samples = design_matrix(SplineBasis(breaks), x);
  const Eigen::VectorXd target = Eigen::Map<const Eigen::VectorXd>(z.data(), as_index(z.size()));
  return solve(samples, Eigen::VectorXd::Ones(target.size()), target,
               std::sqrt(smoothing) * third_difference(samples.cols()));
}

}  // namespace ehm::engine_sim
