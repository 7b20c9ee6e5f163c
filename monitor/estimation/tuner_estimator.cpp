// SPDX-License-Identifier: Apache-2.0
#include "monitor/estimation/tuner_estimator.h"

#include <algorithm>

#include "deploy/runtime/numbers/index.h"
#include "monitor/estimation/sensor_choice.h"

namespace ehm::estimation {

namespace {

/// n + t of the largest set.
Eigen::Index most_states(const std::vector<ErrorModel>& sets) {
  Eigen::Index most = 0;
  for (const ErrorModel& set : sets) most = std::max(most, set.closed_loop.rows());
  return most;
}

}  // namespace

TunerEstimator::TunerEstimator(const TunerEstimatorModel& model, const PointDistance& distance)
    : filter_(model.filter),
      errors_(model.errors),
      error_(errors_->front(), most_states(*errors_)),
      distance_(distance),
      sensor_trim_(model.sensor_trim),
      dy_(model.sensor_trim.size()),
      actuator_trim_(model.actuator_trim),
      du_(model.actuator_trim.size()) {
  read_out();
}

std::unique_ptr<Estimator> TunerEstimator::clone() const {
  auto other = std::make_unique<TunerEstimator>(*this);
  other->reset();
  return other;
}

void TunerEstimator::reset() noexcept {
  filter_.reset();
  error_.reset(errors_->front());
  held_samples_ = 0;
  read_out();
}

bool TunerEstimator::use(SensorMask available) noexcept {
  const int missing = only_missing(filter_.model().full.sensors, available);
  if (missing == filter_.sensor_set().missing()) return true;
  if (missing == several_missing || (missing >= 0 && !filter_.available(SensorSet::without(missing)))) return false;
  if (!filter_.sensor_set().is_full()) take_back();
  if (missing >= 0) leave_out(missing, false, 0.0);
  return true;
}

void TunerEstimator::predict(const Conditions& before, int steps) noexcept {
  du_ = before.actuators - actuator_trim_;
  for (int k = 1; k < steps; ++k) {
    filter_.predict(du_);
    filter_.update({});  // a lost sample fuses nothing
  }
  filter_.predict(du_);
}

void TunerEstimator::innovate(const SensorVector& y, const Conditions& now) noexcept {
  dy_ = y - sensor_trim_;
  du_ = now.actuators - actuator_trim_;
  filter_.innovation(dy_, du_);
  innovation_.value = filter_.innovation();
  innovation_.variance = filter_.innovation_variance().cwiseMax(error_.innovation_variance());
}

void TunerEstimator::update(SensorMask fused, std::int64_t hold) noexcept {
  filter_.update(fused);
  if (++held_samples_ >= hold) {
    held_samples_ = 0;
    error_.step();
  }
  read_out();
}

void TunerEstimator::widen(double excess) noexcept {
  error_.widen(excess);
  read_out_sigmas();
}

bool TunerEstimator::start_without(int sensor) noexcept {
  reset();
  if (!filter_.switch_sensor_set(SensorSet::without(sensor))) return false;
  error_.reset(error_model(sensor));
  read_out();
  return true;
}

void TunerEstimator::leave_out(int sensor, bool knows_it, double fading) noexcept {
  const HealthVector health = filter_.health();
  const AuxiliaryVector auxiliary = filter_.auxiliary();
  filter_.switch_sensor_set(SensorSet::without(sensor));
  error_.switch_to(error_model(sensor), filter_.gain().from_full);
  if (knows_it) filter_.carry(health, auxiliary, fading);
}

void TunerEstimator::take_back() noexcept {
  error_.switch_to(errors_->front(), filter_.gain().to_full);
  filter_.switch_sensor_set(SensorSet::full());
}

void TunerEstimator::save(EstimatorState& state) const noexcept {
  state.missing_sensor = filter_.sensor_set().missing();
  state.held_samples = held_samples_;
  state.estimate = filter_.estimate();
  error_.save(state.error);
}

bool TunerEstimator::restore(const EstimatorState& state) noexcept {
  const int missing = std::max(-1, state.missing_sensor);
  if (as_size(1 + missing) >= errors_->size() || !fits(state.error, error_model(missing))) return false;
  if (!filter_.restore(missing < 0 ? SensorSet::full() : SensorSet::without(missing), state.estimate)) return false;
  error_.restore(error_model(missing), state.error);
  held_samples_ = state.held_samples;
  read_out();
  return true;
}

void TunerEstimator::fly_blind(const ActuatorVector& actuators, std::uint64_t steps) noexcept {
  du_ = actuators - actuator_trim_;
  for (std::uint64_t k = steps; k > 0; --k) {
    filter_.predict(du_);
    filter_.update({});
  }
}

void TunerEstimator::read_out() noexcept {
  estimate_.health = filter_.health();
  estimate_.auxiliary = filter_.auxiliary();
  estimate_.tuners = filter_.tuners();
  estimate_.sensors = filter_.sensors();
  estimate_.health_sigma_filter = filter_.health_sigma_filter();
  estimate_.auxiliary_sigma_filter = filter_.auxiliary_sigma_filter();
  read_out_sigmas();
}

void TunerEstimator::read_out_sigmas() noexcept {
  estimate_.health_sigma = error_.health_sigma();
  estimate_.auxiliary_sigma = error_.auxiliary_sigma();
  estimate_.settled = error_.settled();
}

}  // namespace ehm::estimation
