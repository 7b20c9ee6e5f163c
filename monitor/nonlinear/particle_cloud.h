// SPDX-License-Identifier: Apache-2.0
#pragma once
// N weighted particles of n states: drawn from a Gaussian, summed up, resampled. The weights are kept as logarithms, of
// which only differences count.
//   mean  sum w_i X_i        covariance  sum w_i (X_i - x)(X_i - x)'        N_eff = 1/sum w_i^2
//   systematic resampling: particle i is taken as often as (u + k)/N, k = 0..N-1, falls into its share of the sum of w;
//   one uniform number u in (0, 1] for all of them, which has the least variance of the usual schemes
// Shapes: states N x n, by state in memory. Source: Douc & Cappe 2005. Errors: none; draw() is false where the
// covariance has no Cholesky factor. Real-time safe: yes, after construction.

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "deploy/runtime/numbers/noise_source.h"
#include "monitor/nonlinear/state_space.h"

namespace ehm::nonlinear {

class ParticleCloud {
 public:
  ParticleCloud(Eigen::Index particles, Eigen::Index order, std::uint64_t seed);

  Eigen::Index count() const noexcept { return states_.rows(); }
  OrderVector state(Eigen::Index i) const noexcept { return states_.row(i).transpose(); }
  void set(Eigen::Index i, const OrderVector& x) noexcept { states_.row(i) = x.transpose(); }

  /// From its first number on again, all particles of equal weight.
  void restart() noexcept;
  bool draw(const OrderVector& mean, const OrderMatrix& covariance) noexcept;
  /// Adds independent noise to every particle.
  void scatter(const OrderVector& variance) noexcept;
  OrderVector normal_vector() noexcept;

  void add_log_weight(Eigen::Index i, double change) noexcept { log_weights_(i) += change; }
  /// It counts no more, until the next resampling.
  void discard(Eigen::Index i) noexcept { log_weights_(i) = -std::numeric_limits<double>::infinity(); }
  bool discarded(Eigen::Index i) const noexcept { return !std::isfinite(log_weights_(i)); }
  /// Brings the weights to a sum of 1. False: none of them counts.
  bool normalise() noexcept;
  /// After normalise().
  double weight(Eigen::Index i) const noexcept { return weights_(i); }
  double effective_count() const noexcept { return 1.0 / weights_.squaredNorm(); }
  OrderVector mean() const noexcept { return states_.transpose() * weights_; }
  OrderMatrix covariance(const OrderVector& mean) const noexcept;
  /// Where fewer than 2/3 of them count. sources() tells which particle each is a copy of.
  bool resample_if_needed() noexcept;
  const std::vector<Eigen::Index>& sources() const noexcept { return sources_; }

 private:
  std::uint64_t seed_;
  NoiseSource random_;
  Eigen::MatrixXd states_, spare_;
  Eigen::VectorXd weights_, log_weights_;
  std::vector<Eigen::Index> sources_;
};

}  // namespace ehm::nonlinear
