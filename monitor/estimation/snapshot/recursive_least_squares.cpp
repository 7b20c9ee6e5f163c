// SPDX-License-Identifier: Apache-2.0
#include "monitor/estimation/snapshot/recursive_least_squares.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "deploy/runtime/numbers/index.h"

namespace ehm::estimation {

RecursiveLeastSquares::RecursiveLeastSquares(std::shared_ptr<const SnapshotModel> model, double kept)
    : model_(std::move(model)), kept_(kept) {
  if (!(kept_ > 0.0 && kept_ <= 1.0))
    throw std::invalid_argument("recursive least squares: lambda is " + std::to_string(kept_) +
                                "; allowed: above 0, at most 1");
  reset();
}

std::unique_ptr<SnapshotMethod> RecursiveLeastSquares::fresh() const {
  return std::make_unique<RecursiveLeastSquares>(model_, kept_);
}

void RecursiveLeastSquares::reset() noexcept {
  health_.setZero(model_->health());
  error_ = nothing_seen(*model_);
}

bool RecursiveLeastSquares::restore(const HealthVector& health, const SnapshotError& error) noexcept {
  constexpr double rounding = 1e-9;
  HealthCovariance covariance = -error.health_bias;
  if (covariance != covariance.transpose() || !(covariance.diagonal().maxCoeff() <= 1.0 + rounding)) return false;
  covariance.diagonal().array() += rounding;
  if (covariance.llt().info() != Eigen::Success) return false;
  health_ = health;
  error_ = error;
  return true;
}

bool RecursiveLeastSquares::correct(const HealthVector& health) noexcept {
  health_ = health;
  return true;
}

void RecursiveLeastSquares::pass(int samples) noexcept {
  for (int k = 0; k < samples; ++k) move_on(*model_, error_);
  if (kept_ < 1.0) forget(std::pow(kept_, samples));
}

void RecursiveLeastSquares::forget(double kept) noexcept {
  HealthCovariance blend = (kept - 1.0) * error_.health_bias;  // lambda I + (1 - lambda) P
  blend.diagonal().array() += kept;
  const Eigen::LLT<HealthCovariance> factor(blend);
  const HealthVector health = factor.solve(health_);
  health_ = kept * health;
  const HealthCovariance bias = factor.solve(error_.health_bias);
  error_.health_bias = 0.5 * (bias + bias.transpose());
  const BoundedMatrix<max_health, max_offsets> offset = factor.solve(error_.offset_bias);
  error_.offset_bias = kept * offset;
  const BoundedMatrix<max_health, max_states> cross = factor.solve(error_.motion_cross.transpose());
  error_.motion_cross = kept * cross.transpose();
  const HealthCovariance left = factor.solve(error_.noise).transpose();  // S T
  const HealthCovariance both = factor.solve(left);
  error_.noise = 0.5 * kept * kept * (both + both.transpose());
}

bool RecursiveLeastSquares::update(const SensorVector& readings, SensorMask fused) noexcept {
  for (Eigen::Index i = 0; i < model_->sensors(); ++i)
    if (fused[as_size(i)]) fuse(i, readings(i));
  return true;  // what earlier samples have taught is an answer, too
}

void RecursiveLeastSquares::fuse(Eigen::Index sensor, double reading) noexcept {
  const HealthVector c = model_->health_signal.row(sensor);
  const StateVector state = model_->state_signal.row(sensor);
  HealthVector b = HealthVector::Zero(c.size());  // P c^T, by columns, which lie together in memory
  for (Eigen::Index j = 0; j < c.size(); ++j) b -= error_.health_bias.col(j) * c(j);
  const double root = std::sqrt(c.dot(b) + 1.0);
  b /= root;
  const HealthVector g = b / root;
  health_ += g * (reading - c.dot(health_));
  for (Eigen::Index o = 0; o < model_->offsets(); ++o)
    error_.offset_bias.col(o) += g * (model_->offset_signal(sensor, o) - c.dot(error_.offset_bias.col(o)));

  // eta = Cn dx + v - c eps
  const HealthVector own = error_.noise.lazyProduct(c);
  const StateVector mixed = error_.motion_cross.lazyProduct(c);
  const StateVector moved = model_->motion.lazyProduct(state);
  HealthVector with_eta = error_.motion_cross.transpose().lazyProduct(state);  // cov(eps, eta)
  with_eta -= own;
  const double eta = state.dot(moved) + 1.0 - 2.0 * state.dot(mixed) + c.dot(own);
  error_.motion_cross += (moved - mixed).lazyProduct(g.transpose());
  // column by column from terms that are the same in both halves, so that S and P stay symmetric to the last bit
  const HealthVector half = with_eta + 0.5 * eta * g;
  for (Eigen::Index j = 0; j < g.size(); ++j)
    for (Eigen::Index i = 0; i < g.size(); ++i) {
      error_.noise(i, j) += half(i) * g(j) + g(i) * half(j);
      error_.health_bias(i, j) += b(i) * b(j);
    }
}

}  // namespace ehm::estimation
