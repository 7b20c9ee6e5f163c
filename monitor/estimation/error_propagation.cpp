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

bool fits(const ErrorState& state, const ErrorModel& model) noexcept {
  return state.mean.rows() == model.drive.rows() && state.mean.cols() == model.drive.cols() &&
         state.covariance.rows() == model.noise.rows() && state.covariance.cols() == model.noise.cols() &&
         state.remaining >= 0 && state.remaining <= model.settling_samples;
}

ErrorPropagation::ErrorPropagation(const ErrorModel& model, Eigen::Index most_states)
    : model_(&model), mean_(most_states * model.drive.cols()), covariance_(most_states * most_states) {
  reset(model);
}

void ErrorPropagation::reset(const ErrorModel& model) noexcept {
  model_ = &model;
  excess_ = 1.0;
  remaining_ = model.settling_samples;
  keep(Mean::Zero(model.drive.rows(), model.drive.cols()), model.start);
}

void ErrorPropagation::switch_to(const ErrorModel& model, const Covariance& transfer) noexcept {
  model_ = &model;
  remaining_ = model.settling_samples;
  const Covariance before = covariance_.load(), product = transfer.lazyProduct(before);
  const Mean mean = mean_.load();
  keep(transfer.lazyProduct(mean), product.lazyProduct(transfer.transpose()));
}

void ErrorPropagation::switch_to(const ErrorModel& model) noexcept {
  model_ = &model;
  remaining_ = model.settling_samples;
  read_out(mean_.load(), covariance_.load());
}

void ErrorPropagation::save(ErrorState& state) const noexcept {
  state.mean = mean_.load();
  state.covariance = covariance_.load();
  state.remaining = remaining_;
}

void ErrorPropagation::restore(const ErrorModel& model, const ErrorState& state) noexcept {
  model_ = &model;
  remaining_ = state.remaining;
  keep(state.mean, state.covariance);
}

void ErrorPropagation::step() noexcept {
  if (settled()) return;
  const ErrorModel& m = *model_;
  const Mean before = mean_.load();
  Mean mean = m.closed_loop.lazyProduct(before);
  mean += m.drive;
  Covariance covariance = covariance_.load();
  const Covariance product = m.closed_loop.lazyProduct(covariance);
  covariance.noalias() = product.lazyProduct(m.closed_loop.transpose());
  covariance += m.noise;
  --remaining_;
  keep(mean, covariance);
}

void ErrorPropagation::keep(const Mean& mean, const Covariance& covariance) noexcept {
  mean_.keep(mean);
  covariance_.keep(covariance);
  read_out(mean, covariance);
}

void ErrorPropagation::read_out(const Mean& mean, const Covariance& covariance) noexcept {
  const ErrorModel& m = *model_;
  BoundedMatrix<max_health, max_unknowns> health_bias = m.health_output.lazyProduct(mean);  // Th M - Gh
  health_bias -= m.health_truth;
  const BoundedMatrix<max_health, max_augmented> health_spread = m.health_output.lazyProduct(covariance);  // Th S
  BoundedMatrix<max_auxiliary, max_unknowns> auxiliary_bias = m.auxiliary_output.lazyProduct(mean);        // Tz M - Gz
  auxiliary_bias -= m.auxiliary_truth;
  const BoundedMatrix<max_auxiliary, max_augmented> auxiliary_spread =
      m.auxiliary_output.lazyProduct(covariance);                                         // Tz S
  BoundedMatrix<max_sensors, max_unknowns> sensor_bias = m.prediction.lazyProduct(mean);  // C A M - Gy
  sensor_bias -= m.sensor_truth;
  const BoundedMatrix<max_sensors, max_augmented> sensor_spread = m.prediction.lazyProduct(covariance);  // C A S

  const Eigen::Index health = m.health_truth.rows();
  split(health_bias, health_spread, m.health_output, health, health_parts_);
  split(auxiliary_bias, auxiliary_spread, m.auxiliary_output, health, auxiliary_parts_);
  innovation_variance_.resize(m.sensor_scale.size());
  for (Eigen::Index i = 0; i < innovation_variance_.size(); ++i)
    innovation_variance_(i) =
        m.sensor_scale(i) * m.sensor_scale(i) *
        (sensor_bias.row(i).squaredNorm() + sensor_spread.row(i).dot(m.prediction.row(i)) + m.innovation_noise(i));
  publish();
}

HealthCovariance ErrorPropagation::health_covariance() const noexcept {
  const ErrorModel& m = *model_;
  const Mean mean = mean_.load();
  const Covariance spread = covariance_.load();
  BoundedMatrix<max_health, max_unknowns> bias = m.health_output.lazyProduct(mean);  // Th M - Gh
  bias -= m.health_truth;
  const Eigen::Index health = m.health_truth.rows();
  bias.leftCols(health) *= std::sqrt(excess_);
  bias.rightCols(bias.cols() - health) *= excess_;
  const BoundedMatrix<max_health, max_augmented> noise = m.health_output.lazyProduct(spread);  // Th S
  HealthCovariance covariance = bias.lazyProduct(bias.transpose());
  covariance += noise.lazyProduct(m.health_output.transpose());
  return m.health_scale.asDiagonal() * covariance * m.health_scale.asDiagonal();
}

void ErrorPropagation::publish() noexcept {
  health_sigma_ = health_parts_.sigma(excess_, model_->health_scale);
  auxiliary_sigma_ = auxiliary_parts_.sigma(excess_, model_->auxiliary_scale);
}

}  // namespace ehm::estimation
