// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/search/kalman_objective.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "monitor/estimation/linear/doubling.h"
#include "monitor/estimation/linear/small_product.h"
#include "tuner_design/theory/read_out.h"

namespace ehm::tuner_design {
namespace {

using estimation::BoundedMatrix;
using estimation::max_augmented;
using estimation::max_auxiliary;
using estimation::max_health;
using estimation::max_sensors;
using SensorByState = BoundedMatrix<max_sensors, max_augmented>;
using StateBySensor = BoundedMatrix<max_augmented, max_sensors>;
using SensorMatrix = BoundedMatrix<max_sensors, max_sensors>;
using HealthByTuner = BoundedMatrix<max_health, estimation::max_tuners>;
using OutputByState = BoundedMatrix<max_health + max_auxiliary, max_augmented>;
/// Unknowns: health, sensors and outputs each at most once.
inline constexpr int max_unknowns = max_health + max_sensors + max_auxiliary;
using StateByEngine = BoundedMatrix<max_augmented, estimation::max_states>;
using StateByUnknown = BoundedMatrix<max_augmented, max_unknowns>;
using OutputByUnknown = BoundedMatrix<max_health + max_auxiliary, max_unknowns>;

/// Everything of the forward pass that the backward pass needs.
struct Forward {
  StateMatrix A, P, I_KC, closed_loop, noise, output_weight;  ///< Axq, P, I - K Cxq, Acl, Z, T^T Omega T
  SensorByState C;                                            ///< Cxq
  StateBySensor K;
  Eigen::LLT<SensorMatrix> innovation;  ///< of S
  OutputByState T, weighted_T;          ///< T, Omega T
  StateByUnknown mean;                  ///< X
  StateByEngine driven;                 ///< the first n columns of (I - K Cxq) Qw; the others are zero
  OutputByUnknown weighted_miss;        ///< Omega D
  Eigen::PartialPivLU<StateMatrix> one_minus_closed_loop;
};

void augment(const PointProblem& point, const HealthByTuner& W, Forward& f) {
  const Eigen::Index n = point.A.rows(), t = W.cols(), p = W.rows(), r = point.F.rows(), m = point.C.rows();
  f.A.setIdentity(n + t, n + t);
  f.A.topLeftCorner(n, n) = point.A;
  f.A.topRightCorner(n, t).noalias() = point.L.lazyProduct(W);
  f.C.resize(m, n + t);
  f.C.leftCols(n) = point.C;
  f.C.rightCols(t).noalias() = point.M.lazyProduct(W);
  f.T.setZero(p + r, n + t);
  f.T.topRightCorner(p, t) = W;
  f.T.bottomLeftCorner(r, n) = point.F;
  f.T.bottomRightCorner(r, t).noalias() = point.N.lazyProduct(W);
}

/// Omega T and T^T Omega T.
void weigh_outputs(const PointProblem& point, Forward& f) {
  const Eigen::Index p = point.Gh.rows(), r = point.Gz.rows();
  f.weighted_T.resize(p + r, f.T.cols());
  f.weighted_T.topRows(p) = point.health_weight * f.T.topRows(p);
  f.weighted_T.bottomRows(r) = point.auxiliary_weight.asDiagonal() * f.T.bottomRows(r);
  estimation::multiply(f.output_weight, f.T.transpose(), f.weighted_T);
}

/// P, K and Acl. @returns false if there is none.
bool close_loop(const PointProblem& point, double qh, Forward& f) {
  const Eigen::Index n = point.A.rows(), size = f.A.rows();
  SensorByState weighted = point.sensor_variance.cwiseInverse().asDiagonal() * f.C;
  StateMatrix information;
  estimation::multiply(information, f.C.transpose(), weighted);
  f.P.setZero(size, size);
  f.P.topLeftCorner(n, n) = point.process_noise;
  f.P.diagonal().tail(size - n).setConstant(qh);
  if (!estimation::doubling::solve_riccati(f.A, information, f.P)) return false;

  SensorByState CP;
  estimation::multiply(CP, f.C, f.P);
  SensorMatrix S;
  estimation::multiply(S, CP, f.C.transpose());
  S.diagonal() += point.sensor_variance;
  f.innovation.compute(S);
  if (f.innovation.info() != Eigen::Success) return false;
  f.K = f.innovation.solve(CP).transpose();
  estimation::multiply(f.I_KC, f.K, f.C);
  f.I_KC *= -1.0;
  f.I_KC.diagonal().array() += 1.0;
  estimation::multiply(f.closed_loop, f.I_KC, f.A);
  return true;
}

/// X and Z.
void settle(const PointProblem& point, const estimation::doubling::Powers<StateMatrix>& powers, Forward& f) {
  StateMatrix difference = -f.closed_loop;
  difference.diagonal().array() += 1.0;
  f.one_minus_closed_loop.compute(difference);
  StateByUnknown drive;
  estimation::multiply(drive, f.K, point.Gy);
  f.mean = f.one_minus_closed_loop.solve(drive);

  const StateBySensor weighted_K = f.K * point.sensor_variance.asDiagonal();
  estimation::multiply(f.noise, weighted_K, f.K.transpose());
  const Eigen::Index n = point.A.rows();
  f.driven.noalias() = f.I_KC.leftCols(n).lazyProduct(point.process_noise);
  f.noise.noalias() += f.driven.lazyProduct(f.I_KC.leftCols(n).transpose());
  powers.solve(f.noise);
}

/// J.
double error(const PointProblem& point, Forward& f) {
  const Eigen::Index p = point.Gh.rows(), r = point.Gz.rows();
  weigh_outputs(point, f);
  OutputByUnknown miss;
  estimation::multiply(miss, f.T, f.mean);
  miss.topRows(p) -= point.Gh;
  miss.bottomRows(r) -= point.Gz;
  f.weighted_miss.resize(p + r, miss.cols());
  f.weighted_miss.topRows(p) = point.health_weight * miss.topRows(p);
  f.weighted_miss.bottomRows(r) = point.auxiliary_weight.asDiagonal() * miss.bottomRows(r);
  return miss.cwiseProduct(f.weighted_miss).sum() + f.output_weight.cwiseProduct(f.noise).sum();
}

/// dJ/dW from the forward pass.
HealthByTuner backward(const PointProblem& point, const estimation::doubling::Powers<StateMatrix>& powers,
                       const Forward& f) {
  const Eigen::Index n = point.A.rows(), t = f.A.rows() - n, p = point.Gh.rows(), r = point.Gz.rows();
  // U = (I - Acl)^-T 2 T^T Omega D and Y = Acl^T Y Acl + T^T Omega T
  StateByUnknown drive;
  estimation::multiply(drive, f.T.transpose(), f.weighted_miss);
  drive *= 2.0;
  const StateByUnknown U = f.one_minus_closed_loop.transpose().solve(drive);
  StateMatrix Y = f.output_weight;
  powers.solve_transposed(Y);

  // Aclb = U X^T + 2 Y Acl Z
  StateMatrix closed_loop_bar, left;
  estimation::multiply(left, Y, f.closed_loop);
  estimation::multiply(closed_loop_bar, left, f.noise);
  closed_loop_bar *= 2.0;
  closed_loop_bar.noalias() += U.lazyProduct(f.mean.transpose());

  // Kb = U Gy^T + 2 Y K R - B C^T,   B = Aclb A^T + 2 Y (I - K C) Qw
  StateBySensor K_bar, more;
  estimation::multiply(K_bar, Y, f.K);
  K_bar = (2.0 * K_bar * point.sensor_variance.asDiagonal()).eval();
  K_bar.noalias() += U.lazyProduct(point.Gy.transpose());
  StateMatrix passed;  // B
  estimation::multiply(passed, closed_loop_bar, f.A.transpose());
  passed.leftCols(n) += 2.0 * Y.lazyProduct(f.driven);
  K_bar.noalias() -= passed.lazyProduct(f.C.transpose());

  // Kb S^-1, and what it leaves on P and C
  more = f.innovation.solve(K_bar.transpose()).transpose();
  StateBySensor through;  // (I - K C)^T Kb S^-1
  estimation::multiply(through, f.I_KC.transpose(), more);
  StateMatrix P_bar;
  estimation::multiply(P_bar, through, f.C);
  estimation::doubling::symmetrise(P_bar);
  SensorMatrix Z;  // (Kb S^-1)^T K
  estimation::multiply(Z, more.transpose(), f.K);
  SensorByState CP, C_bar;
  estimation::multiply(CP, f.C, f.P);
  estimation::multiply(C_bar, more.transpose(), f.P);
  C_bar.noalias() -= Z.lazyProduct(CP);
  C_bar.noalias() -= Z.transpose().lazyProduct(CP);
  C_bar.noalias() -= f.K.transpose().lazyProduct(passed);

  // Phi = A'^T Phi A' + Pb through Phi' on the powers of Acl
  StateMatrix phi, inner;
  estimation::multiply(left, P_bar, f.A);
  estimation::multiply(inner, f.A.transpose(), left);
  powers.solve_transposed(inner);
  estimation::multiply(left, inner, f.I_KC);
  estimation::multiply(phi, f.I_KC.transpose(), left);
  phi += P_bar;

  // Axqb = (I - K C)^T Aclb + 2 Phi A P+,   Cxqb += -2 K^T A^T Phi A P+,   P+ = (I - K C) P
  StateMatrix updated, phi_A, A_bar;
  estimation::multiply(updated, f.I_KC, f.P);
  estimation::multiply(left, phi, f.A);
  estimation::multiply(phi_A, left, updated);
  estimation::multiply(A_bar, f.I_KC.transpose(), closed_loop_bar);
  A_bar += 2.0 * phi_A;
  estimation::multiply(left, f.A.transpose(), phi_A);
  C_bar.noalias() -= 2.0 * f.K.transpose().lazyProduct(left);

  HealthByTuner W_bar = HealthByTuner::Zero(p, t);
  if (!point.own_readout) {  // one of least error has no slope
    // Tb = 2 Omega D X^T + 2 Omega T Z
    OutputByState T_bar;
    estimation::multiply(T_bar, f.weighted_miss, f.mean.transpose());
    T_bar.noalias() += f.weighted_T.lazyProduct(f.noise);
    T_bar *= 2.0;
    W_bar = T_bar.topRightCorner(p, t);
    W_bar.noalias() += point.N.transpose().lazyProduct(T_bar.bottomRightCorner(r, t));
  }
  W_bar.noalias() += point.L.transpose().lazyProduct(A_bar.topRightCorner(n, t));
  W_bar.noalias() += point.M.transpose().lazyProduct(C_bar.rightCols(t));
  return W_bar;
}

}  // namespace

std::optional<double> kalman_objective(const PointProblem& point, const Eigen::MatrixXd& V, double qh_percent2,
                                       Eigen::MatrixXd* gradient) {
  const HealthByTuner W = V.transpose();
  Forward f;
  augment(point, W, f);
  if (!close_loop(point, qh_percent2, f)) return std::nullopt;
  const estimation::doubling::Powers<StateMatrix> powers(f.closed_loop);
  if (!powers.converged()) return std::nullopt;
  settle(point, powers, f);
  if (point.own_readout && !set_read_out(f.T, f.mean, f.noise, point.Gh, point.Gz, V.rows())) return std::nullopt;
  const double value = error(point, f);
  if (gradient != nullptr) {
    HealthByTuner W_bar = backward(point, powers, f);
    // What lies in the row space changes nothing: W_bar <- (I - W W^T) W_bar
    BoundedMatrix<estimation::max_tuners, estimation::max_tuners> inside;
    estimation::multiply(inside, W.transpose(), W_bar);
    W_bar.noalias() -= W.lazyProduct(inside);
    *gradient = W_bar.transpose();
  }
  return value;
}

}  // namespace ehm::tuner_design
