// SPDX-License-Identifier: Apache-2.0
#pragma once
// The factorisations of a matrix of doubles that the design and the loading of a design use: L U, Cholesky, Householder
// Q R, singular values, symmetric and general eigenvalues. They are compiled once (decompositions.cpp): instantiated in
// every file that solves something, they are most of what it costs the compiler (measured: JacobiSVD 9.7 s a file
// against 2.3 s, PartialPivLU 5.9 s against 3.3 s). Include this instead of <Eigen/SVD> and its kin.

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace Eigen {

extern template class PartialPivLU<MatrixXd>;
extern template class LLT<MatrixXd>;
extern template LLT<MatrixXd>& LLT<MatrixXd>::compute(const EigenBase<MatrixXd>&);
extern template class HouseholderQR<MatrixXd>;
extern template class ColPivHouseholderQR<MatrixXd>;
extern template ColPivHouseholderQR<MatrixXd>& ColPivHouseholderQR<MatrixXd>::compute(const EigenBase<MatrixXd>&);
extern template class CompleteOrthogonalDecomposition<MatrixXd>;
extern template class JacobiSVD<MatrixXd>;
extern template class SelfAdjointEigenSolver<MatrixXd>;
extern template SelfAdjointEigenSolver<MatrixXd>& SelfAdjointEigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&,
                                                                                            int);
extern template class EigenSolver<MatrixXd>;
extern template EigenSolver<MatrixXd>& EigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&, bool);

}  // namespace Eigen
