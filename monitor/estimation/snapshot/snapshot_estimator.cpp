// SPDX-License-Identifier: Apache-2.0
#include "monitor/estimation/snapshot/snapshot_estimator.h"

#include <algorithm>
#include <utility>

#include "deploy/runtime/numbers/index.h"

namespace ehm::estimation {

SnapshotEstimator::SnapshotEstimator(std::shared_ptr<const SnapshotSetting> setting,
                                     std::unique_ptr<SnapshotMethod> method, const PointDistance& distance)
    : setting_(std::move(setting)), method_(std::move(method)), distance_(distance) {
  for (Eigen::Index i = 0; i < setting_->model->sensors(); ++i) all_.set(as_size(i));
  reset();
}

std::unique_ptr<Estimator> SnapshotEstimator::clone() const {
  return std::make_unique<SnapshotEstimator>(setting_, method_->fresh(), distance_);
}

void SnapshotEstimator::reset() noexcept {
  const SnapshotModel& model = *setting_->model;
  method_->reset();
  du_.setZero(model.B.cols());
  controls_.setZero(model.states());
  readings_.setZero(model.sensors());
  excess_ = 1.0;
  begun_ = false;
  unanswered_ = 0;
  remaining_ = setting_->settling_samples;
  innovation_.value = readings_;
  innovation_.variance = readings_;
  estimate_.sensors = all_;
  estimate_.holds = true;
  read_out();
}

bool SnapshotEstimator::use(SensorMask available) noexcept {
  if ((available & all_).none()) return false;
  estimate_.sensors = available & all_;
  return true;
}

void SnapshotEstimator::predict(const Conditions& before, int steps) noexcept {
  const SnapshotModel& model = *setting_->model;
  du_ = before.actuators - setting_->units.actuator_trim;
  if (!begun_) {
    controls_ = model.balance.lazyProduct(du_);
    --steps;
  }
  begun_ = true;
  for (int k = 0; k < steps; ++k) {
    StateVector moved = model.A.lazyProduct(controls_);
    moved += model.B.lazyProduct(du_);
    controls_ = moved;
  }
  if (steps > 0) method_->pass(steps);
}

void SnapshotEstimator::innovate(const SensorVector& y, const Conditions& now) noexcept {
  const SnapshotModel& model = *setting_->model;
  const ChannelUnits& units = setting_->units;
  du_ = now.actuators - units.actuator_trim;
  readings_ = units.deviation(y).cwiseQuotient(model.noise_sigma);
  readings_ -= model.actuator_out.lazyProduct(du_);
  readings_ -= model.state_signal.lazyProduct(controls_);
  const SensorVector scale = units.sensor_scale.cwiseProduct(model.noise_sigma);
  innovation_.value = readings_;
  innovation_.value -= model.health_signal.lazyProduct(method_->health());
  innovation_.value = innovation_.value.cwiseProduct(scale).eval();
  innovation_.variance = innovation_variance(model, method_->error()).sigma(1.0, scale).cwiseAbs2();
}

void SnapshotEstimator::update(SensorMask fused, std::int64_t hold) noexcept {
  if (method_->update(readings_, fused & estimate_.sensors)) {
    unanswered_ = 0;
    if (remaining_ > 0) --remaining_;
  } else {
    ++unanswered_;
  }
  estimate_.holds = unanswered_ < std::max<std::int64_t>(hold, 1);
  read_out();
}

void SnapshotEstimator::widen(double excess) noexcept {
  if (excess == excess_) return;
  excess_ = excess;
  read_out_sigmas();
}

void SnapshotEstimator::save(EstimatorState& state) const noexcept {
  const SnapshotModel& model = *setting_->model;
  state.missing_sensor = -1;
  state.held_samples = unanswered_;
  state.estimate.resize(model.states() + model.health());
  state.estimate.head(model.states()) = controls_;
  state.estimate.tail(model.health()) = method_->health();
  estimation::save(model, method_->error(), state.error);
  state.error.remaining = remaining_;
}

bool SnapshotEstimator::restore(const EstimatorState& state) noexcept {
  const SnapshotModel& model = *setting_->model;
  SnapshotError error;
  if (state.estimate.size() != model.states() + model.health() || state.held_samples < 0 || state.error.remaining < 0 ||
      state.error.remaining > setting_->settling_samples || !estimation::restore(model, state.error, error) ||
      !method_->restore(state.estimate.tail(model.health()), error))
    return false;
  controls_ = state.estimate.head(model.states());
  unanswered_ = state.held_samples;
  estimate_.holds = unanswered_ == 0;
  remaining_ = state.error.remaining;
  begun_ = true;
  read_out();
  return true;
}

HealthVector SnapshotEstimator::health_scale() const noexcept {
  return setting_->units.health_scale.cwiseProduct(setting_->model->health_sigma);
}

HealthCovariance SnapshotEstimator::health_covariance() const noexcept {
  const HealthVector scale = health_scale();
  const HealthCovariance covariance = estimation::health_covariance(method_->error(), excess_);
  return scale.asDiagonal() * covariance * scale.asDiagonal();
}

bool SnapshotEstimator::correct_health(const HealthVector& health) noexcept {
  const HealthVector scaled = setting_->units.scaled_health(health);
  if (!method_->correct(scaled.cwiseQuotient(setting_->model->health_sigma))) return false;
  read_out();
  return true;
}

void SnapshotEstimator::read_out() noexcept {
  const SnapshotModel& model = *setting_->model;
  const ChannelUnits& units = setting_->units;
  estimate_.health = units.health(model.health_sigma.cwiseProduct(method_->health()));
  AuxiliaryVector auxiliary = model.state_output.lazyProduct(controls_);
  auxiliary += model.G.lazyProduct(du_);
  auxiliary += model.health_output.lazyProduct(method_->health());
  estimate_.auxiliary = units.auxiliary(auxiliary);
  const HealthCovariance own = method_->own_covariance();
  const BoundedMatrix<max_auxiliary, max_health> seen = model.health_output.lazyProduct(own);
  const HealthVector health = own.diagonal().cwiseMax(0.0).cwiseSqrt();
  const AuxiliaryVector outputs = seen.cwiseProduct(model.health_output).rowwise().sum().cwiseMax(0.0).cwiseSqrt();
  estimate_.health_sigma_filter = health_scale().cwiseProduct(health);
  estimate_.auxiliary_sigma_filter = units.auxiliary_scale.cwiseProduct(outputs);
  estimate_.settled = remaining_ <= 0;
  read_out_sigmas();
}

void SnapshotEstimator::read_out_sigmas() noexcept {
  estimate_.health_sigma = health_variance(method_->error()).sigma(excess_, health_scale());
  estimate_.auxiliary_sigma =
      auxiliary_variance(*setting_->model, method_->error()).sigma(excess_, setting_->units.auxiliary_scale);
}

}  // namespace ehm::estimation
