// SPDX-License-Identifier: Apache-2.0
#include "monitor/nonlinear/nonlinear_estimator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine_sim/model/parts/inlet.h"
#include "monitor/onboard/learned.h"

namespace ehm::nonlinear {
namespace {

using estimation::Conditions;
using onboard::speed_count;

constexpr double nominal_step_s = 0.015;
constexpr double measured_speed_sigma = 1.0, unmeasured_speed_sigma = 2.0;  ///< percent, at the start
constexpr int longest_gap_samples = 8;
constexpr double longest_without_answer_s = 1.0, settling_time_s = 60.0;

double square(double x) {
  return x * x;
}

SensorMask first_sensors(Eigen::Index count) {
  SensorMask all;
  for (Eigen::Index i = 0; i < count; ++i) all.set(as_size(i));
  return all;
}

}  // namespace

FilterNoise engine_noise(const onboard::OnBoardModel& model) {
  const onboard::OnBoardOptions& o = model.options();
  const double steps = o.sample_time_s / nominal_step_s;
  OrderVector variance(speed_count + as_index(model.definition().channels.health.size()));
  variance.setConstant(steps * square(o.health_walk_percent));
  variance.head<speed_count>().setConstant(steps * square(o.speed_walk_percent));
  return {variance};
}

NonlinearEstimator::NonlinearEstimator(std::shared_ptr<const onboard::OnBoardModel> model,
                                       std::unique_ptr<NonlinearFilter> filter, NonlinearTraits traits)
    : model_(std::move(model)),
      space_(model_, EngineStateSpace::Metal::with),
      filter_(std::move(filter)),
      traits_(traits),
      prior_(onboard::learned_nothing(*model_)),
      fleet_trace_(prior_.covariance.diagonal().head(health_count()).sum()) {
  estimate_.sensors = first_sensors(space_.sensor_count());
  reset();
}

std::unique_ptr<estimation::Estimator> NonlinearEstimator::clone() const {
  return std::make_unique<NonlinearEstimator>(model_, filter_->clone(), traits_);
}

void NonlinearEstimator::reset() noexcept {
  metal_known_ = false;
  estimate_.sensors = first_sensors(space_.sensor_count());
  start_cold();
}

void NonlinearEstimator::start_cold() noexcept {
  const Eigen::Index p = health_count(), m = space_.sensor_count();
  OrderVector x = OrderVector::Zero(space_.order());
  x.tail(p) = prior_.value.head(p);
  OrderMatrix covariance = OrderMatrix::Zero(space_.order(), space_.order());
  covariance.bottomRightCorner(p, p) = prior_.covariance.topLeftCorner(p, p);
  filter_->start(x, covariance);
  lagged_.setZero(m);
  own_noise_.setOnes(m);
  innovation_.value.setZero(m);
  innovation_.variance.setZero(m);
  innovation_.noise.setZero(m);
  estimate_.auxiliary.setZero(as_index(model_->auxiliary().size()));
  estimate_.auxiliary_sigma = estimate_.auxiliary_sigma_filter = estimate_.auxiliary;
  estimate_.tuners.resize(0);
  estimate_.holds = true;
  excess_ = 1.0;
  samples_ = lost_ = 0;
  begun_ = teach_ = false;
  first_ = true;
  read_out();
}

estimation::Learned NonlinearEstimator::learned() const noexcept {
  const Eigen::Index p = health_count();
  estimation::Learned learned;
  learned.value = filter_->estimate().tail(p);
  learned.covariance = filter_->covariance().bottomRightCorner(p, p);
  return learned;
}

bool NonlinearEstimator::begin_with(const estimation::Learned& known, double wear_percent) noexcept {
  if (known.value.size() != prior_.value.size() || known.covariance.rows() != prior_.covariance.rows() ||
      known.covariance.cols() != prior_.covariance.cols())
    return false;
  prior_ = onboard::after_wear(known, *model_, wear_percent);
  reset();
  return true;
}

void NonlinearEstimator::next_flight(double wear_percent) noexcept {
  prior_ = onboard::after_wear(learned(), *model_, wear_percent);
  OrderVector opened = OrderVector::Zero(space_.order());
  opened.tail(health_count()).setConstant(square(wear_percent));
  filter_->open(opened);
}

estimation::HealthCovariance NonlinearEstimator::health_covariance() const noexcept {
  const Eigen::Index p = health_count();
  return (1e-4 * excess_) * filter_->covariance().bottomRightCorner(p, p);  // fractions
}

bool NonlinearEstimator::use(SensorMask available) noexcept {
  const SensorMask all = first_sensors(space_.sensor_count());
  if ((available & all).none()) return false;
  estimate_.sensors = available & all;
  return true;
}

void NonlinearEstimator::predict(const Conditions&, int steps) noexcept {
  if (!begun_) return;
  for (int k = 0; k < std::min(steps, longest_gap_samples); ++k) {
    if (!filter_->advance(space_)) return lose();
    space_.advance_metal();
  }
  // Nobody knows what the engine did meanwhile; its speeds will be measured.
  if (steps > longest_gap_samples) begun_ = false;
}

bool NonlinearEstimator::start(const SensorVector& y) noexcept {
  std::array<double, speed_count> measured;
  OrderVector variance = OrderVector::Zero(space_.order());
  for (int k = 0; k < speed_count; ++k) {
    const int sensor = model_->speed_sensor(k);
    const bool known = sensor >= 0 && estimate_.sensors[as_size(sensor)] && y(sensor) > 0.0;
    measured[as_size(k)] = known ? y(sensor) : std::numeric_limits<double>::quiet_NaN();
    variance(k) = square(known ? measured_speed_sigma : unmeasured_speed_sigma);
  }
  OrderVector x = filter_->estimate();
  if (!space_.start(measured, metal_known_, x)) return false;
  metal_known_ = true;
  OrderMatrix covariance = filter_->covariance();
  covariance.topRows<speed_count>().setZero();
  covariance.leftCols<speed_count>().setZero();
  covariance.diagonal().head<speed_count>() = variance.head<speed_count>();
  filter_->start(x, covariance);
  if (first_) lagged_ = y.array().isFinite().select(y, 0.0);
  return space_.refer(x);
}

/// What each reading's noise is now, and what the filter makes of it.
bool NonlinearEstimator::foresee() noexcept {
  const double early =
      0.01 * traits_.early_gain_percent * filter_->covariance().diagonal().tail(health_count()).sum() / fleet_trace_;
  const double steps = model_->options().sample_time_s / nominal_step_s;
  SensorVector sigma(space_.sensor_count());
  for (Eigen::Index i = 0; i < sigma.size(); ++i) {
    own_noise_(i) = square(model_->noise_sigma(as_size(i), lagged_(i)));
    sigma(i) = std::sqrt(own_noise_(i) + square(early * lagged_(i)) / steps);
  }
  if (traits_.reference == Reference::by_estimator && !space_.refer(filter_->estimate())) return false;
  return filter_->foresee(space_, sigma);
}

void NonlinearEstimator::innovate(const SensorVector& y, const Conditions& now) noexcept {
  space_.set(now);
  estimate_.holds = (begun_ || start(y)) && foresee();
  if (!estimate_.holds) return lose();
  lost_ = 0;
  begun_ = true;
  const auto& sensors = model_->definition().channels.sensors;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const auto at = as_index(i);
    const double gain =
        first_ || sensors[i].lag_s <= 0.0 ? 1.0 : 1.0 - std::exp(-model_->options().sample_time_s / sensors[i].lag_s);
    lagged_(at) += gain * (filter_->predicted()(at) - lagged_(at));
  }
  first_ = false;
  teach_ = space_.n1_corrected_rpm() >= model_->options().least_n1 * model_->design_n1_corrected_rpm();
  innovation_.value = y - lagged_;
  innovation_.variance = filter_->innovation_variance();
  innovation_.noise = own_noise_;
}

void NonlinearEstimator::lose() noexcept {
  innovation_.value.setZero();
  innovation_.variance.setConstant(std::numeric_limits<double>::infinity());
  if (static_cast<double>(++lost_) * model_->options().sample_time_s > longest_without_answer_s && begun_) start_cold();
  estimate_.holds = false;
}

void NonlinearEstimator::update(SensorMask fused, std::int64_t) noexcept {
  if (!estimate_.holds) return;
  SensorMask taught = fused & estimate_.sensors;
  if (!teach_) {
    SensorMask speeds;
    for (int k = 0; k < speed_count; ++k)
      if (model_->speed_sensor(k) >= 0) speeds.set(as_size(model_->speed_sensor(k)));
    taught &= speeds;
  }
  if (!filter_->update(space_, innovation_.value, taught)) return lose();
  ++samples_;
  read_out();
}

void NonlinearEstimator::widen(double excess) noexcept {
  if (excess == excess_) return;
  const double ratio = std::sqrt(excess / excess_);
  excess_ = excess;
  estimate_.health_sigma *= ratio;
  estimate_.auxiliary_sigma *= ratio;
}

void NonlinearEstimator::read_out() noexcept {
  const Eigen::Index p = health_count();
  estimate_.health = 0.01 * filter_->estimate().tail(p);
  estimate_.health_sigma_filter = 0.01 * filter_->covariance().diagonal().tail(p).cwiseMax(0.0).cwiseSqrt();
  estimate_.health_sigma = std::sqrt(excess_) * estimate_.health_sigma_filter;
  estimate_.settled = static_cast<double>(samples_) * model_->options().sample_time_s >= settling_time_s;
  if (!begun_) return;
  estimate_.auxiliary = space_.outputs(filter_->estimate());
  const OutputSlopes& z = space_.output_slopes();
  estimate_.auxiliary_sigma_filter =
      (z * filter_->covariance()).cwiseProduct(z).rowwise().sum().cwiseMax(0.0).cwiseSqrt();
  estimate_.auxiliary_sigma = std::sqrt(excess_) * estimate_.auxiliary_sigma_filter;
}

double NonlinearEstimator::distance(const Conditions& conditions) const noexcept {
  const engine_sim::FlightCondition flight{conditions.flight.altitude_m, conditions.flight.mach,
                                           conditions.flight.delta_isa_k};
  return engine_sim::covers(flight) ? 0.0 : 2.0;
}

void NonlinearEstimator::save(estimation::EstimatorState& state) const noexcept {
  state = {};
  state.learned = learned();
}

bool NonlinearEstimator::restore(const estimation::EstimatorState& state) noexcept {
  return begin_with(state.learned, 0.0);
}

}  // namespace ehm::nonlinear
