// SPDX-License-Identifier: Apache-2.0
#include "monitor/estimation/time_varying_filter.h"

#include <cmath>
#include <utility>

#include "deploy/runtime/numbers/index.h"

namespace ehm::estimation {

TimeVaryingFilter::TimeVaryingFilter(std::shared_ptr<const FullOrderModel> model)
    : model_(std::move(model)), outputs_(model_->sensor_output.transpose()) {
  reset();
}

void TimeVaryingFilter::reset() noexcept {
  estimate_.setZero(model_->prior.rows());
  covariance_ = model_->prior;
  measured_.setZero(model_->D.rows());
  innovation_ = measured_;
  innovation_variance_ = measured_;
  gain_.setZero(model_->prior.rows());
  actuators_.setZero(model_->D.cols());
  offset_.setZero(model_->prior.rows(), model_->sensor_offset.cols());
  read_out();
}

bool TimeVaryingFilter::restore(const AugmentedVector& estimate, const FullOrderCovariance& covariance,
                                const BoundedMatrix<max_augmented, max_unknowns>& offset) noexcept {
  if (estimate.size() != estimate_.size() || covariance.rows() != covariance_.rows() ||
      covariance.cols() != covariance_.cols() || offset.rows() != offset_.rows() || offset.cols() != offset_.cols())
    return false;
  estimate_ = estimate;
  covariance_ = covariance;
  offset_ = offset;
  read_out();
  return true;
}

void TimeVaryingFilter::predict(const ActuatorVector& du_previous) noexcept {
  const Eigen::Index n = model_->A.rows(), p = model_->L.cols();
  // x <- A x + B u + L h
  StateVector state = model_->A.lazyProduct(estimate_.head(n));
  state += model_->B.lazyProduct(du_previous);
  state += model_->L.lazyProduct(estimate_.tail(p));
  estimate_.head(n) = state;
  if (offset_.cols() > 0) {
    BoundedMatrix<max_states, max_offsets> moved = model_->A.lazyProduct(offset_.topRows(n));
    moved += model_->L.lazyProduct(offset_.bottomRows(p));
    offset_.topRows(n) = moved;
  }

  // T = A Pxh + L Phh
  const BoundedMatrix<max_states, max_health> moved_cross = model_->A.lazyProduct(covariance_.topRightCorner(n, p));
  BoundedMatrix<max_states, max_health> cross = moved_cross;
  cross += model_->L.lazyProduct(covariance_.bottomRightCorner(p, p));
  // Pxx <- A Pxx A^T + T L^T + L (A Pxh)^T + Q
  const BoundedMatrix<max_states, max_states> moved_state = model_->A.lazyProduct(covariance_.topLeftCorner(n, n));
  BoundedMatrix<max_states, max_states> block = model_->process_noise;
  block += moved_state.lazyProduct(model_->A.transpose());
  block += cross.lazyProduct(model_->L.transpose());
  block += model_->L.lazyProduct(moved_cross.transpose());
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index i = 0; i < n; ++i) covariance_(i, j) = 0.5 * (block(i, j) + block(j, i));
  }
  covariance_.topRightCorner(n, p) = cross;
  covariance_.bottomLeftCorner(p, n) = cross.transpose();
}

void TimeVaryingFilter::innovation(const SensorVector& dy, const ActuatorVector& du) noexcept {
  actuators_ = du;
  measured_ = dy;
  measured_ -= model_->D.lazyProduct(du);
  innovation_ = measured_;
  innovation_ -= model_->sensor_output.lazyProduct(estimate_);
  // diag(c P c^T) + R
  for (Eigen::Index i = 0; i < innovation_variance_.size(); ++i) {
    project(i);
    innovation_variance_(i) = outputs_.col(i).dot(gain_) + model_->sensor_noise_variance(i);
  }
}

void TimeVaryingFilter::update(SensorMask fused) noexcept {
  for (Eigen::Index i = 0; i < measured_.size(); ++i) {
    if (fused[as_size(i)]) fuse(i);
  }
  read_out();
}

void TimeVaryingFilter::fuse(Eigen::Index sensor) noexcept {
  const auto c = outputs_.col(sensor);
  // s = c P c^T + r,  b = P c^T / sqrt(s)
  project(sensor);
  const double root = std::sqrt(c.dot(gain_) + model_->sensor_noise_variance(sensor));
  gain_ /= root;
  // xhat <- xhat + b (y - D u - c xhat) / sqrt(s)
  const double residual = measured_(sensor) - c.dot(estimate_);
  estimate_ += gain_ * (residual / root);
  // D <- D + b (Ey_i - c D) / sqrt(s)
  for (Eigen::Index e = 0; e < offset_.cols(); ++e)
    offset_.col(e) += gain_ * ((model_->sensor_offset(sensor, e) - c.dot(offset_.col(e))) / root);
  // P <- P - b b^T, symmetric because b_i b_j = b_j b_i also in floating point
  for (Eigen::Index j = 0; j < gain_.size(); ++j) covariance_.col(j) -= gain_ * gain_(j);
}

void TimeVaryingFilter::project(Eigen::Index sensor) noexcept {
  // P c^T by columns, which lie together in memory
  gain_.setZero();
  for (Eigen::Index j = 0; j < gain_.size(); ++j) gain_ += covariance_.col(j) * outputs_(j, sensor);
}

HealthVector TimeVaryingFilter::health_variance() const noexcept {
  return covariance_.diagonal().tail(model_->L.cols());
}

AuxiliaryVector TimeVaryingFilter::auxiliary_variance() const noexcept {
  const BoundedMatrix<max_auxiliary, max_augmented> seen = model_->auxiliary_output.lazyProduct(covariance_);
  return seen.cwiseProduct(model_->auxiliary_output).rowwise().sum();
}

HealthVector TimeVaryingFilter::health_offset_variance() const noexcept {
  return offset_.bottomRows(model_->L.cols()).rowwise().squaredNorm();
}

AuxiliaryVector TimeVaryingFilter::auxiliary_offset_variance() const noexcept {
  // Tz D - Ez: what the offsets do to the estimate, beside what they are in the engine itself
  BoundedMatrix<max_auxiliary, max_offsets> error = model_->auxiliary_output.lazyProduct(offset_);
  error -= model_->auxiliary_offset;
  return error.rowwise().squaredNorm();
}

void TimeVaryingFilter::read_out() noexcept {
  health_ = estimate_.tail(model_->L.cols());
  auxiliary_ = model_->auxiliary_output.lazyProduct(estimate_);
  auxiliary_ += model_->G.lazyProduct(actuators_);
}

}  // namespace ehm::estimation
