// SPDX-License-Identifier: Apache-2.0
#include "monitor/estimation/constrained/constrained_estimator.h"

#include <utility>

#include "monitor/estimation/constrained/truncated_gaussian.h"

namespace ehm::estimation {

ConstrainedEstimator::ConstrainedEstimator(std::unique_ptr<Estimator> inner, const ConstrainedOptions& options)
    : inner_(std::move(inner)), options_(options), constraint_(options.direction) {
  start();
}

std::unique_ptr<Estimator> ConstrainedEstimator::clone() const {
  return std::make_unique<ConstrainedEstimator>(inner_->clone(), options_);
}

void ConstrainedEstimator::start() noexcept {
  constraint_.lift();
  bound_ = false;
  sigma_share_.setOnes(options_.direction.size());
  publish(inner_->estimate().health);
}

void ConstrainedEstimator::reset() noexcept {
  inner_->reset();
  start();
}

bool ConstrainedEstimator::begin_with(const Learned& known, double wear_percent) noexcept {
  if (!inner_->begin_with(known, wear_percent)) return false;
  start();  // between two flights there may have been a washing
  return true;
}

bool ConstrainedEstimator::use(SensorMask available) noexcept {
  const bool answer = inner_->use(available);
  publish(HealthVector(estimate_.health));
  return answer;
}

void ConstrainedEstimator::update(SensorMask fused, std::int64_t hold) noexcept {
  inner_->update(fused, hold);
  constrain();
  if (!estimate_.settled || !estimate_.holds) return;
  const HealthVector margin = options_.margin_sigma * inner_->estimate().health_sigma;
  constraint_.take(estimate_.health - options_.direction.cwiseProduct(margin));
  bound_ = true;
}

void ConstrainedEstimator::constrain() noexcept {
  const HealthVector &lower = constraint_.lower(), &upper = constraint_.upper();
  HealthVector health = inner_->estimate().health;
  sigma_share_.setOnes();
  if (bound_ && options_.way != ConstraintWay::projection_identity) {
    HealthCovariance covariance = inner_->health_covariance();
    if (options_.way == ConstraintWay::projection) {
      project_onto_box(covariance, lower, upper, health);
    } else {
      const HealthVector before = covariance.diagonal();
      if (truncate_to_box(lower, upper, health, covariance))
        sigma_share_ = (before.array() > 0.0).select((covariance.diagonal().cwiseQuotient(before)).cwiseSqrt(), 1.0);
    }
  }
  if (bound_) health = clamped_to_box(health, lower, upper);
  if (options_.feeds_back && health != inner_->estimate().health) inner_->correct_health(health);
  publish(health);
}

void ConstrainedEstimator::publish(const HealthVector& health) noexcept {
  estimate_ = inner_->estimate();
  estimate_.health = health;
  estimate_.health_sigma = estimate_.health_sigma.cwiseProduct(sigma_share_);
}

void ConstrainedEstimator::widen(double excess) noexcept {
  inner_->widen(excess);
  publish(HealthVector(estimate_.health));
}

void ConstrainedEstimator::save(EstimatorState& state) const noexcept {
  inner_->save(state);
  state.constrained = {};
  if (bound_) state.constrained = {constraint_.bounds(), estimate_.health, sigma_share_};
}

bool ConstrainedEstimator::restore(const EstimatorState& state) noexcept {
  const auto fits = [&](const HealthVector& v) { return v.size() == options_.direction.size() && v.allFinite(); };
  const ConstrainedState& own = state.constrained;
  const bool bound = own.bound.size() > 0;
  if (bound && !(fits(own.bound) && fits(own.health) && fits(own.sigma_share))) return false;
  if (!inner_->restore(state)) return false;
  start();
  if (!bound) return true;
  constraint_.take(own.bound);
  bound_ = true;
  sigma_share_ = own.sigma_share;
  publish(own.health);
  return true;
}

}  // namespace ehm::estimation
