// SPDX-License-Identifier: Apache-2.0
#include "monitor/estimation/gauss_markov_estimator.h"

#include <algorithm>
#include <utility>

#include "deploy/runtime/numbers/index.h"
#include "monitor/estimation/sensor_choice.h"

namespace ehm::estimation {

GaussMarkovEstimator::GaussMarkovEstimator(std::shared_ptr<const GaussMarkovModel> model, const PointDistance& distance)
    : model_(std::move(model)),
      filter_(model_->model, set().gain),
      error_(set().error),
      distance_(distance),
      du_(model_->units.actuator_trim.size()) {
  reset();
}

std::unique_ptr<Estimator> GaussMarkovEstimator::clone() const {
  return std::make_unique<GaussMarkovEstimator>(model_, distance_);
}

void GaussMarkovEstimator::reset() noexcept {
  set_ = 0;
  held_samples_ = 0;
  filter_.use(set().gain);
  filter_.reset();
  error_.reset(set().error);
  innovation_.value.setZero(model_->units.sensor_trim.size());
  innovation_.variance = innovation_.value;
  read_out();
}

bool GaussMarkovEstimator::use(SensorMask available) noexcept {
  const int missing = only_missing(model_->sets.front()->sensors, available);
  if (missing == several_missing) return false;
  const auto wanted = as_size(1 + missing);
  if (wanted == set_) return true;
  if (!model_->sets[wanted]) return false;
  set_ = wanted;
  filter_.use(set().gain);
  error_.switch_to(set().error);
  return true;
}

void GaussMarkovEstimator::predict(const Conditions& before, int steps) noexcept {
  du_ = before.actuators - model_->units.actuator_trim;
  for (int k = 0; k < steps; ++k) filter_.predict(du_);
}

void GaussMarkovEstimator::innovate(const SensorVector& y, const Conditions& now) noexcept {
  const ChannelUnits& units = model_->units;
  du_ = now.actuators - units.actuator_trim;
  filter_.innovation(units.deviation(y), du_);
  innovation_.value = filter_.innovation().cwiseProduct(units.sensor_scale);
  innovation_.variance = filter_.innovation_variance().cwiseProduct(units.sensor_scale.cwiseAbs2());
  innovation_.variance = innovation_.variance.cwiseMax(error_.innovation_variance());
}

void GaussMarkovEstimator::update(SensorMask fused, std::int64_t hold) noexcept {
  filter_.update(fused & set().sensors);
  if (++held_samples_ >= hold) {
    held_samples_ = 0;
    error_.step();
  }
  read_out();
}

void GaussMarkovEstimator::widen(double excess) noexcept {
  error_.widen(excess);
  read_out_sigmas();
}

void GaussMarkovEstimator::save(EstimatorState& state) const noexcept {
  state.missing_sensor = static_cast<int>(set_) - 1;
  state.held_samples = held_samples_;
  state.estimate = filter_.estimate();
  error_.save(state.error);
}

bool GaussMarkovEstimator::restore(const EstimatorState& state) noexcept {
  const auto set_of_state = as_size(1 + std::max(-1, state.missing_sensor));
  if (set_of_state >= model_->sets.size() || !model_->sets[set_of_state]) return false;
  if (!fits(state.error, model_->sets[set_of_state]->error) || !filter_.restore(state.estimate)) return false;
  set_ = set_of_state;
  filter_.use(set().gain);
  error_.restore(set().error, state.error);
  held_samples_ = state.held_samples;
  read_out();
  return true;
}

bool GaussMarkovEstimator::correct_health(const HealthVector& health) noexcept {
  const FullOrderModel& model = *model_->model;
  const Eigen::Index n = model.A.rows(), p = model.L.cols();
  AugmentedVector moved = filter_.estimate();
  const HealthVector change = model_->units.scaled_health(health) - moved.tail(p);
  // the prior is [X Ph; Ph], X = (I-A)^-1 L, and Ph diagonal
  const HealthVector fleet = model.prior.diagonal().tail(p);
  for (Eigen::Index j = 0; j < p; ++j)
    if (fleet(j) > 0.0) moved.head(n) += (change(j) / fleet(j)) * model.prior.col(n + j).head(n);
  moved.tail(p) += change;
  filter_.restore(moved);
  read_out();
  return true;
}

void GaussMarkovEstimator::read_out() noexcept {
  estimate_.health = model_->units.health(filter_.health());
  estimate_.auxiliary = model_->units.auxiliary(filter_.auxiliary());
  estimate_.health_sigma_filter = set().health_sigma_filter;
  estimate_.auxiliary_sigma_filter = set().auxiliary_sigma_filter;
  estimate_.sensors = set().sensors;
  read_out_sigmas();
}

void GaussMarkovEstimator::read_out_sigmas() noexcept {
  estimate_.health_sigma = error_.health_sigma();
  estimate_.auxiliary_sigma = error_.auxiliary_sigma();
  estimate_.settled = error_.settled();
}

}  // namespace ehm::estimation
