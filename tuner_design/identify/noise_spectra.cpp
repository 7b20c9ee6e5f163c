// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/identify/noise_spectra.h"

#include <Eigen/LU>
#include <algorithm>
#include <numbers>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/sensor_noise.h"
#include "engine_sim/linear_model/stationary_covariance.h"

namespace ehm::tuner_design {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

namespace {

/// D(w)/n
Complex held_response(double omega, int n) {
  Complex sum = 0.0;
  for (int k = 0; k < n; ++k) sum += std::polar(1.0, -omega * k);
  return sum / static_cast<double>(n);
}

}  // namespace

NoiseSpectra::NoiseSpectra(const linear_model::LinearModel& scaled) : model_(scaled) {
  const Index n = scaled.A.rows();
  for (Index i = 0; i < scaled.C.rows(); ++i) {
    terms_.push_back({NoiseKind::sensor, static_cast<int>(i)});
    held_.push_back(linear_model::held_samples(scaled, i));
  }
  const MatrixXd& Q = scaled.process_noise;
  const bool none = Q.isZero(0.0), diagonal = Q.isDiagonal(0.0);
  if (!diagonal) {
    terms_.push_back({NoiseKind::motion, -1});
    motion_roots_.push_back(linear_model::covariance_root(Q));
  }
  for (Index j = 0; diagonal && j < n; ++j) {
    if (!none && Q(j, j) == 0.0) continue;
    terms_.push_back({NoiseKind::motion, static_cast<int>(j)});
    motion_roots_.emplace_back(MatrixXd::Identity(n, n).col(j));
  }
  for (Index i = 0; i < scaled.L.cols(); ++i) terms_.push_back({NoiseKind::walk, static_cast<int>(i)});
}

double NoiseSpectra::highest_omega() const {
  return std::numbers::pi / *std::max_element(held_.begin(), held_.end());
}

void NoiseSpectra::add_at(double omega, double weight, std::vector<MatrixXcd>& sums) const {
  const Index n = model_.A.rows();
  const Complex z = std::polar(1.0, omega), step = 1.0 - std::conj(z);
  // C (zI - A)^-1
  const MatrixXcd zI_A = z * MatrixXcd::Identity(n, n) - model_.A;
  MatrixXcd CX = zI_A.transpose().partialPivLu().solve(model_.C.transpose().cast<Complex>()).transpose();
  MatrixXcd direct = model_.M.cast<Complex>();
  std::vector<Complex> hold;
  for (const int each : held_) hold.push_back(held_response(omega, each));
  for (Index i = 0; i < CX.rows(); ++i) {
    CX.row(i) *= hold[as_size(i)];
    direct.row(i) *= hold[as_size(i)];
  }
  const MatrixXcd walk = CX * model_.L + direct;
  std::size_t motion = 0;
  for (std::size_t t = 0; t < terms_.size(); ++t) {
    const Index channel = terms_[t].channel;
    if (terms_[t].kind == NoiseKind::sensor) {
      sums[t](channel, channel) += weight * std::norm(step) * std::norm(hold[as_size(channel)]);
    } else if (terms_[t].kind == NoiseKind::walk) {
      sums[t].noalias() += weight * walk.col(channel) * walk.col(channel).adjoint();
    } else {
      const MatrixXcd a = step * (CX * motion_roots_[motion++]);
      sums[t].noalias() += weight * a * a.adjoint();
    }
  }
}

}  // namespace ehm::tuner_design
