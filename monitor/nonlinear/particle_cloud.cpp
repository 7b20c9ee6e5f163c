// SPDX-License-Identifier: Apache-2.0
#include "monitor/nonlinear/particle_cloud.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "deploy/runtime/numbers/index.h"

namespace ehm::nonlinear {

ParticleCloud::ParticleCloud(Eigen::Index particles, Eigen::Index order, std::uint64_t seed)
    : seed_(seed),
      random_(seed),
      states_(Eigen::MatrixXd::Zero(particles, order)),
      spare_(states_),
      weights_(Eigen::VectorXd::Constant(particles, 1.0 / static_cast<double>(particles))),
      log_weights_(Eigen::VectorXd::Zero(particles)),
      sources_(as_size(particles), 0) {}

void ParticleCloud::restart() noexcept {
  random_ = NoiseSource(seed_);
  log_weights_.setZero();
  weights_.setConstant(1.0 / static_cast<double>(count()));
}

OrderVector ParticleCloud::normal_vector() noexcept {
  OrderVector z(states_.cols());
  for (double& value : z) value = random_.normal();
  return z;
}

bool ParticleCloud::draw(const OrderVector& mean, const OrderMatrix& covariance) noexcept {
  const Eigen::LLT<OrderMatrix> factor(covariance);
  if (factor.info() != Eigen::Success) return false;
  const OrderMatrix s = factor.matrixL();
  for (Eigen::Index i = 0; i < count(); ++i) set(i, mean + s * normal_vector());
  return true;
}

void ParticleCloud::scatter(const OrderVector& variance) noexcept {
  const OrderVector sigma = variance.cwiseSqrt();
  for (Eigen::Index i = 0; i < count(); ++i) set(i, state(i) + sigma.cwiseProduct(normal_vector()));
}

bool ParticleCloud::normalise() noexcept {
  const double greatest = log_weights_.maxCoeff();
  if (!std::isfinite(greatest)) return false;
  log_weights_.array() -= greatest;
  weights_ = log_weights_.array().exp();
  weights_ /= weights_.sum();
  return true;
}

OrderMatrix ParticleCloud::covariance(const OrderVector& mean) const noexcept {
  OrderMatrix p = OrderMatrix::Zero(mean.size(), mean.size());
  for (Eigen::Index i = 0; i < count(); ++i) {
    const OrderVector d = state(i) - mean;
    p.noalias() += (weights_(i) * d) * d.transpose();
  }
  return p;
}

bool ParticleCloud::resample_if_needed() noexcept {
  const auto n = static_cast<double>(count());
  if (effective_count() >= n * 2.0 / 3.0) return false;
  const double u = random_.uniform();
  double sum = weights_(0);
  Eigen::Index from = 0;
  for (Eigen::Index k = 0; k < count(); ++k) {
    const double at = (u + static_cast<double>(k)) / n;
    while (at > sum && from + 1 < count()) sum += weights_(++from);
    sources_[as_size(k)] = from;
    spare_.row(k) = states_.row(from);
  }
  states_.swap(spare_);
  log_weights_.setZero();
  weights_.setConstant(1.0 / n);
  return true;
}

}  // namespace ehm::nonlinear
