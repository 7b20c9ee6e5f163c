// SPDX-License-Identifier: Apache-2.0
#pragma once
// Objective J (point_problem.h) of the steady-state Kalman filter on the tuners V, and its gradient by the adjoint.
// For orthonormal rows the pseudoinverse is W = V^T and V Qh V^T = qh I. With E = blkdiag(I_n, W), n + t columns:
//   Axq = E^T [A L; 0 I] E    Cxq = [C M] E    T = [0 I; F N] E    Qxq = blkdiag(Q, qh I)
//   P    Riccati,  K = P Cxq^T S^-1,  S = Cxq P Cxq^T + R,  Acl = (I - K Cxq) Axq
//   X    = (I - Acl)^-1 K Gy                         mean of [x; q] per unknown of the fleet
//   Z    = Acl Z Acl^T + K R K^T + (I - K Cxq) Qw (I - K Cxq)^T     noise, Qw = blkdiag(Q, 0): kalman_error.h
//   T    for a model that knows its linearisation error: [0 Rh; F Rz] of read_out.h, which has no slope where it is best
//   J    = <D, Omega D> + <T^T Omega T, Z>,  D = T X - [Gh; Gz],  Omega = diag(wh I, wz)
// Backwards (bars are derivatives of J): one linear solve and two more Lyapunov equations on the same powers of Acl,
//   U    = (I - Acl)^-T 2 T^T Omega D,   Y = Acl^T Y Acl + T^T Omega T
//   Aclb = U X^T + 2 Y Acl Z,   B = Aclb Axq^T + 2 Y (I - K Cxq) Qw        B: of I - K Cxq
//   Kb   = U Gy^T + 2 Y K R - B Cxq^T,   Cxqb = -K^T B + ...
//   Pb   = sym[(I - K Cxq)^T Kb S^-1 Cxq],  Phi = A'^T Phi A' + Pb,  A' = Axq (I - K Cxq), which is
//          Phi = (I-KC)^T Phi' (I-KC) + Pb,  Phi' = Acl^T Phi' Acl + Axq^T Pb Axq
// and dJ/dV is what of (dJ/dW)^T leaves the row space: only the row space of V matters (theory.md, sections 2, 6). For
// rows that are not orthonormal, V = T Vo, the gradient is T^-T times that of Vo.
// Source: own derivation; the Riccati derivative as in theory.md, section 6. No allocation but the gradient's.

#include <optional>

#include "tuner_design/theory/point_problem.h"

namespace ehm::tuner_design {

/// J of orthonormal rows V (t x p), and its gradient with respect to V (t x p, orthogonal to the rows of V) if asked
/// for. nullopt if the Riccati equation has no solution or the closed loop is not stable: V is useless.
std::optional<double> kalman_objective(const PointProblem& point, const Eigen::MatrixXd& V, double qh_percent2,
                                       Eigen::MatrixXd* gradient = nullptr);

}  // namespace ehm::tuner_design
