// SPDX-License-Identifier: Apache-2.0
#pragma once
// Row spaces: points of the Grassmannian Gr(t, p), of dimension t (p - t). A tuner matrix V and T V with T invertible
// are the same tuners (theory.md, section 2), so only the row space is searched, and only row spaces are compared.
//   chart       V(X) = row_space(Vo + X No),  No = basis of what the rows of Vo leave out,  X t x (p - t)
//               covers all but a set of measure zero; X = 0 is Vo
//   gradient    dJ/dX = T^-T (dJ/dV) No^T,  Vo + X No = T V,  dJ/dV at the orthonormal V, orthogonal to its rows
//   angles      of two spaces with orthonormal rows V1, V2: arc sines of the singular values of (I - V2^T V2) V1^T,
//               exact also where they are tiny (Bjoerck & Golub, Math. Comp. 27 (1973) 579)

#include <Eigen/Core>

namespace ehm::tuner_design {

/// Orthonormal basis, t x p, of the row space of V (t x p, full row rank), with the sign of a QR decomposition whose
/// triangle has a positive diagonal: the same rows on every machine.
Eigen::MatrixXd row_space(const Eigen::MatrixXd& V);

/// Principal angles in rad, descending. Both matrices have orthonormal rows and the same shape.
Eigen::VectorXd principal_angles(const Eigen::MatrixXd& V1, const Eigen::MatrixXd& V2);

/// Coordinates around one row space.
class RowSpaceChart {
 public:
  /// `centre` has orthonormal rows.
  explicit RowSpaceChart(const Eigen::MatrixXd& centre);

  [[nodiscard]] Eigen::Index dimension() const noexcept { return centre_.rows() * complement_.rows(); }
  /// Orthonormal V at the coordinates x (X column by column), and T if asked for.
  [[nodiscard]] Eigen::MatrixXd at(const Eigen::VectorXd& x, Eigen::MatrixXd* T = nullptr) const;
  /// dJ/dx from dJ/dV at V = at(x, &T).
  [[nodiscard]] Eigen::VectorXd gradient(const Eigen::MatrixXd& V_gradient, const Eigen::MatrixXd& T) const;

 private:
  Eigen::MatrixXd centre_;      ///< Vo
  Eigen::MatrixXd complement_;  ///< No, (p - t) x p, orthonormal rows
};

}  // namespace ehm::tuner_design
