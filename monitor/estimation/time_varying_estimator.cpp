// SPDX-License-Identifier: Apache-2.0
#include "monitor/estimation/time_varying_estimator.h"

#include <Eigen/Cholesky>
#include <utility>

#include "deploy/runtime/numbers/index.h"

namespace ehm::estimation {

TimeVaryingEstimator::TimeVaryingEstimator(std::shared_ptr<const TimeVaryingModel> model, const PointDistance& distance)
    : model_(std::move(model)), filter_(model_->model), distance_(distance), du_(model_->units.actuator_trim.size()) {
  for (Eigen::Index i = 0; i < model_->units.sensor_trim.size(); ++i) all_.set(as_size(i));
  reset();
}

std::unique_ptr<Estimator> TimeVaryingEstimator::clone() const {
  return std::make_unique<TimeVaryingEstimator>(model_, distance_);
}

void TimeVaryingEstimator::reset() noexcept {
  filter_.reset();
  excess_ = 1.0;
  remaining_ = model_->settling_samples;
  begun_ = false;
  innovation_.value.setZero(model_->units.sensor_trim.size());
  innovation_.variance = innovation_.value;
  estimate_.sensors = all_;
  read_out();
}

bool TimeVaryingEstimator::use(SensorMask available) noexcept {
  if ((available & all_).none()) return false;
  estimate_.sensors = available & all_;
  return true;
}

void TimeVaryingEstimator::predict(const Conditions& before, int steps) noexcept {
  du_ = before.actuators - model_->units.actuator_trim;
  for (int k = begun_ ? 0 : 1; k < steps; ++k) filter_.predict(du_);
  begun_ = true;
}

void TimeVaryingEstimator::innovate(const SensorVector& y, const Conditions& now) noexcept {
  const ChannelUnits& units = model_->units;
  du_ = now.actuators - units.actuator_trim;
  filter_.innovation(units.deviation(y), du_);
  innovation_.value = filter_.innovation().cwiseProduct(units.sensor_scale);
  innovation_.variance = filter_.innovation_variance().cwiseProduct(units.sensor_scale.cwiseAbs2());
}

void TimeVaryingEstimator::update(SensorMask fused, std::int64_t) noexcept {
  // What is repeated is not fused, and its variance stays: the hold needs no account of its own here.
  filter_.update(fused & estimate_.sensors);
  if (remaining_ > 0) --remaining_;
  read_out();
}

void TimeVaryingEstimator::widen(double excess) noexcept {
  if (excess == excess_) return;
  excess_ = excess;
  read_out();
}

void TimeVaryingEstimator::save(EstimatorState& state) const noexcept {
  state.missing_sensor = -1;
  state.held_samples = 0;
  state.estimate = filter_.estimate();
  state.error.mean = filter_.offset();
  state.error.covariance = filter_.covariance();
  state.error.remaining = remaining_;
}

bool TimeVaryingEstimator::restore(const EstimatorState& state) noexcept {
  const ErrorState& error = state.error;
  if (error.remaining < 0 || error.remaining > model_->settling_samples) return false;
  if (!filter_.restore(state.estimate, error.covariance, error.mean)) return false;
  remaining_ = error.remaining;
  begun_ = true;
  read_out();
  return true;
}

HealthCovariance TimeVaryingEstimator::health_covariance() const noexcept {
  const Eigen::Index p = model_->model->L.cols();
  const BoundedMatrix<max_health, max_offsets> offset = filter_.offset().bottomRows(p);
  HealthCovariance covariance = excess_ * filter_.covariance().bottomRightCorner(p, p);
  covariance += excess_ * excess_ * offset.lazyProduct(offset.transpose());
  return model_->units.health_scale.asDiagonal() * covariance * model_->units.health_scale.asDiagonal();
}

bool TimeVaryingEstimator::correct_health(const HealthVector& health) noexcept {
  const Eigen::Index n = model_->model->A.rows(), p = model_->model->L.cols();
  AugmentedVector moved = filter_.estimate();
  const HealthVector change = model_->units.scaled_health(health) - moved.tail(p);
  const HealthCovariance own = filter_.covariance().bottomRightCorner(p, p);
  const HealthVector weight = own.ldlt().solve(change);
  moved.head(n) += filter_.covariance().topRightCorner(n, p).lazyProduct(weight);
  moved.tail(p) += change;
  filter_.restore(moved, filter_.covariance(), filter_.offset());
  read_out();
  return true;
}

void TimeVaryingEstimator::read_out() noexcept {
  const ChannelUnits& units = model_->units;
  estimate_.health = units.health(filter_.health());
  estimate_.auxiliary = units.auxiliary(filter_.auxiliary());
  const HealthVector health = filter_.health_variance(), health_offset = filter_.health_offset_variance();
  const AuxiliaryVector auxiliary = filter_.auxiliary_variance(),
                        auxiliary_offset = filter_.auxiliary_offset_variance();
  estimate_.health_sigma_filter = units.health_scale.cwiseProduct(health.cwiseSqrt());
  estimate_.auxiliary_sigma_filter = units.auxiliary_scale.cwiseProduct(auxiliary.cwiseSqrt());
  // What is unknown of the health grows with the fleet's spread, the nonlinearity with its square.
  const double e = excess_;
  estimate_.health_sigma = units.health_scale.cwiseProduct((e * health + e * e * health_offset).cwiseSqrt());
  estimate_.auxiliary_sigma =
      units.auxiliary_scale.cwiseProduct((e * auxiliary + e * e * auxiliary_offset).cwiseSqrt());
  estimate_.settled = remaining_ <= 0;
}

}  // namespace ehm::estimation
