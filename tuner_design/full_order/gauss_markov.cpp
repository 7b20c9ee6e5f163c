#include "tuner_design/full_order/gauss_markov.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>
#include <stdexcept>

#include "tuner_design/math/lyapunov.h"
#include "tuner_design/math/riccati.h"
#include "tuner_design/theory/kalman_error.h"
#include "tuner_design/theory/observability.h"
#include "tuner_design/theory/prepared_point.h"

namespace ehm::tuner_design {
namespace {

/// Spectral radius of the closed loop on all that the sensors see.
double seen_radius(const design::SubsetDesign& design, const linear_model::LinearModel& model, double rho) {
  const Eigen::Index n = model.A.rows(), p = model.L.cols();
  const Eigen::MatrixXd answer = (rho * Eigen::MatrixXd::Identity(n, n) - model.A).partialPivLu().solve(model.L);
  const Eigen::MatrixXd H_rho = model.C * answer + model.M;
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(
      model.sensor_noise_sigma.cwiseInverse().asDiagonal() * H_rho * model.health_sigma.asDiagonal(),
      Eigen::ComputeFullV);
  svd.setThreshold(Observability::relative_tolerance);
  const Eigen::Index unseen = p - svd.rank();
  const Eigen::MatrixXd Acl = design.A - design.K * design.C * design.A;
  if (unseen == 0) return spectral_radius(Acl);
  Eigen::MatrixXd modes(n + p, unseen);
  const Eigen::MatrixXd kernel = model.health_sigma.asDiagonal() * svd.matrixV().rightCols(unseen);
  modes << answer * kernel, kernel;
  // Acl leaves the span of `modes` where it is, so its other eigenvalues are those of its complement's corner.
  const Eigen::MatrixXd basis = Eigen::HouseholderQR<Eigen::MatrixXd>(modes).householderQ();
  const Eigen::MatrixXd rest = basis.rightCols(n + p - unseen);
  return spectral_radius(rest.transpose() * Acl * rest);
}

}  // namespace

double gauss_markov_rho(const linear_model::LinearModel& model, double qh_percent2) {
  const double variance = model.health_sigma.squaredNorm() / static_cast<double>(model.health_sigma.size());
  if (!(qh_percent2 > 0.0 && qh_percent2 < variance)) {
    throw std::invalid_argument("Gauss-Markov filter: qh is " + std::to_string(qh_percent2) +
                                " percent^2 per sample; allowed: above 0 and below the fleet's variance, " +
                                std::to_string(variance));
  }
  return std::sqrt(1.0 - qh_percent2 / variance);
}

design::SubsetDesign gauss_markov_design(const linear_model::LinearModel& model, const estimation::SteadyGain& steady,
                                         double rho) {
  if (!(rho > 0.0 && rho < 1.0)) {
    throw std::invalid_argument("Gauss-Markov filter: rho is " + std::to_string(rho) +
                                "; allowed: above 0 and below 1");
  }
  const Eigen::Index n = model.A.rows(), p = model.L.cols();
  design::SubsetDesign design;
  design.sensors = all_sensors(model);
  design.V.setIdentity(p, p);
  design.W = design.V;
  design.A = rho * Eigen::MatrixXd::Identity(n + p, n + p);
  design.A.topRows(n) << model.A, model.L;
  design.B = Eigen::MatrixXd::Zero(n + p, model.B.cols());
  design.B.topRows(n) = model.B;
  design.C.resize(model.C.rows(), n + p);
  design.C << model.C, model.M;

  Eigen::MatrixXd Q = Eigen::MatrixXd::Zero(n + p, n + p);
  Q.topLeftCorner(n, n) = model.process_noise;
  Q.bottomRightCorner(p, p) = (1.0 - rho * rho) * model.health_sigma.cwiseAbs2().asDiagonal().toDenseMatrix();
  const Eigen::MatrixXd R = model.sensor_noise_sigma.cwiseAbs2().asDiagonal();
  design.P = solve_filter_riccati(design.A, design.C, Q, R);
  // K^T = (C P C^T + R)^-1 C P
  const Eigen::MatrixXd CP = design.C * design.P;
  design.K = (CP * design.C.transpose() + R).llt().solve(CP).transpose();
  add_error_theory(design, model, steady);
  design.slowest_time_constant_s = -model.sample_time_s / std::log(seen_radius(design, model, rho));
  return design;
}

estimation::GaussMarkovGain gauss_markov_gain(const design::SubsetDesign& design, double rho) {
  return {rho, design.K, design.innovation_variance};
}

}  // namespace ehm::tuner_design
