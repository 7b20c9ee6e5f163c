// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/search/row_space.h"

#include "deploy/runtime/numbers/decompositions.h"

namespace ehm::tuner_design {
namespace {

/// Columns that an orthogonal basis starts with: those of V^T; the rest span what they leave out.
Eigen::MatrixXd complement_of(const Eigen::MatrixXd& V) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(V.transpose());
  const Eigen::MatrixXd basis = qr.householderQ() * Eigen::MatrixXd::Identity(V.cols(), V.cols());
  return basis.rightCols(V.cols() - V.rows()).transpose();
}

}  // namespace

Eigen::MatrixXd row_space(const Eigen::MatrixXd& V) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(V.transpose());
  Eigen::MatrixXd basis = qr.householderQ() * Eigen::MatrixXd::Identity(V.cols(), V.rows());
  for (Eigen::Index i = 0; i < V.rows(); ++i) {
    if (qr.matrixQR()(i, i) < 0.0) basis.col(i) = -basis.col(i);
  }
  return basis.transpose();
}

Eigen::VectorXd principal_angles(const Eigen::MatrixXd& V1, const Eigen::MatrixXd& V2) {
  const Eigen::MatrixXd outside = V1.transpose() - V2.transpose() * (V2 * V1.transpose());
  return Eigen::JacobiSVD<Eigen::MatrixXd>(outside).singularValues().cwiseMin(1.0).array().asin();
}

RowSpaceChart::RowSpaceChart(const Eigen::MatrixXd& centre) : centre_(centre), complement_(complement_of(centre)) {}

Eigen::MatrixXd RowSpaceChart::at(const Eigen::VectorXd& x, Eigen::MatrixXd* T) const {
  const Eigen::Map<const Eigen::MatrixXd> X(x.data(), centre_.rows(), complement_.rows());
  const Eigen::MatrixXd moved = centre_ + X * complement_;
  const Eigen::MatrixXd V = row_space(moved);
  if (T != nullptr) *T = moved * V.transpose();
  return V;
}

Eigen::VectorXd RowSpaceChart::gradient(const Eigen::MatrixXd& V_gradient, const Eigen::MatrixXd& T) const {
  const Eigen::MatrixXd X_gradient = T.transpose().partialPivLu().solve(V_gradient * complement_.transpose());
  return X_gradient.reshaped();
}

}  // namespace ehm::tuner_design
