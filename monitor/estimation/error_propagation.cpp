// SPDX-License-Identifier: Apache-2.0
#include "monitor/estimation/error_propagation.h"

#include <cmath>

namespace ehm::estimation {

namespace {

/// Diagonals of bias bias^T, the columns of the health and the others, and of spread output^T.
template <class Bias, class Spread, class Output, class Parts>
void split(const Bias& bias, const Spread& spread, const Output& output, Eigen::Index health, Parts& parts) noexcept {
  parts.prior = bias.leftCols(health).rowwise().squaredNorm();
  parts.nonlinear = bias.rightCols(bias.cols() - health).rowwise().squaredNorm();
  parts.noise = spread.cwiseProduct(output).rowwise().sum();
}

}  // namespace

ErrorPropagation::ErrorPropagation(const ErrorModel& model) : model_(&model) {
  reset(model);
}

void ErrorPropagation::reset(const ErrorModel& model) noexcept {
  model_ = &model;
  excess_ = 1.0;
  mean_.setZero(model.drive.rows(), model.drive.cols());
  covariance_ = model.start;
  remaining_ = model.settling_samples;
  read_out();
}

void ErrorPropagation::switch_to(const ErrorModel& model,
                                 const BoundedMatrix<max_augmented, max_augmented>& transfer) noexcept {
  model_ = &model;
  mean_next_.noalias() = transfer.lazyProduct(mean_);
  mean_ = mean_next_;
  product_.noalias() = transfer.lazyProduct(covariance_);
  covariance_.noalias() = product_.lazyProduct(transfer.transpose());
  remaining_ = model.settling_samples;
  read_out();
}

void ErrorPropagation::restore(const ErrorModel& model, const ErrorState& state) noexcept {
  model_ = &model;
  mean_ = state.mean;
  covariance_ = state.covariance;
  remaining_ = state.remaining;
  read_out();
}

void ErrorPropagation::step() noexcept {
  if (settled()) return;
  const ErrorModel& m = *model_;
  mean_next_.noalias() = m.closed_loop.lazyProduct(mean_);
  mean_ = mean_next_ + m.drive;
  product_.noalias() = m.closed_loop.lazyProduct(covariance_);
  covariance_.noalias() = product_.lazyProduct(m.closed_loop.transpose());
  covariance_ += m.noise;
  --remaining_;
  read_out();
}

void ErrorPropagation::read_out() noexcept {
  const ErrorModel& m = *model_;
  health_bias_.noalias() = m.health_output.lazyProduct(mean_);
  health_bias_ -= m.health_truth;
  health_spread_.noalias() = m.health_output.lazyProduct(covariance_);
  auxiliary_bias_.noalias() = m.auxiliary_output.lazyProduct(mean_);
  auxiliary_bias_ -= m.auxiliary_truth;
  auxiliary_spread_.noalias() = m.auxiliary_output.lazyProduct(covariance_);
  sensor_bias_.noalias() = m.prediction.lazyProduct(mean_);
  sensor_bias_ -= m.sensor_truth;
  sensor_spread_.noalias() = m.prediction.lazyProduct(covariance_);

  const Eigen::Index health = m.health_truth.rows();
  split(health_bias_, health_spread_, m.health_output, health, health_parts_);
  split(auxiliary_bias_, auxiliary_spread_, m.auxiliary_output, health, auxiliary_parts_);
  innovation_variance_.resize(m.sensor_scale.size());
  for (Eigen::Index i = 0; i < innovation_variance_.size(); ++i)
    innovation_variance_(i) =
        m.sensor_scale(i) * m.sensor_scale(i) *
        (sensor_bias_.row(i).squaredNorm() + sensor_spread_.row(i).dot(m.prediction.row(i)) + m.innovation_noise(i));
  publish();
}

void ErrorPropagation::publish() noexcept {
  health_sigma_ = health_parts_.sigma(excess_, model_->health_scale);
  auxiliary_sigma_ = auxiliary_parts_.sigma(excess_, model_->auxiliary_scale);
}

}  // namespace ehm::estimation
