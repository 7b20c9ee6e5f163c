// SPDX-License-Identifier: Apache-2.0
#include "monitor/schedule/scheduled_estimator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/model/thermo/ram.h"

namespace ehm::schedule {
namespace {

using estimation::Conditions;
using estimation::SensorMask;
using estimation::SensorVector;
using estimation::StateVector;

constexpr double nominal_step_s = 0.015, metal_lag_s = 25.0, settling_time_s = 60.0, longest_without_answer_s = 1.0;
constexpr double largest_health_percent = 25.0, largest_state_percent = 400.0;
constexpr double measured_percent = 1.0, unmeasured_percent = 5.0;  ///< of a state, at the start
constexpr double least_move = 0.03;                                 ///< of a path length
constexpr int longest_gap_samples = 8;
constexpr double cells_beyond = 0.25;  ///< so far outside the grid its edge still answers

double square(double x) {
  return x * x;
}

}  // namespace

ScheduledEstimator::ScheduledEstimator(std::shared_ptr<const ScheduledModel> model)
    : model_(std::move(model)),
      states_(model_->state_scale.size()),
      health_(model_->health_scale.size()),
      sensors_(model_->sensor_scale.size()),
      fleet_trace_(model_->health_sigma.squaredNorm()) {
  for (Eigen::Index i = 0; i < sensors_; ++i) estimate_.sensors.set(as_size(i));
  reset();
}

std::unique_ptr<estimation::Estimator> ScheduledEstimator::clone() const {
  return std::make_unique<ScheduledEstimator>(model_);
}

void ScheduledEstimator::reset() noexcept {
  const Eigen::Index n = states_ + health_ + states_ + sensors_;
  xi_.setZero(n);
  p_.setZero(n, n);
  p_.diagonal().segment(states_, health_) = model_->health_sigma.cwiseAbs2();
  x_.setZero(states_);
  u_.resize(0);
  lagged_.setZero(sensors_);
  innovation_.value.setZero(sensors_);
  innovation_.variance.setZero(sensors_);
  innovation_.noise.setZero(sensors_);
  const auto r = as_index(model_->lookup.schedule().auxiliary.size());
  estimate_.auxiliary.setZero(r), estimate_.auxiliary_sigma.setZero(r), estimate_.auxiliary_sigma_filter.setZero(r);
  estimate_.tuners.resize(0);
  estimate_.holds = true;
  excess_ = 1.0;
  eta_ = path_ = n1_corrected_rpm_ = 0.0;
  samples_ = 0;
  lost_ = 0;
  begun_ = teach_ = false;
  read_out();
}

bool ScheduledEstimator::use(SensorMask available) noexcept {
  SensorMask all;
  for (Eigen::Index i = 0; i < sensors_; ++i) all.set(as_size(i));
  if ((available & all).none()) return false;
  estimate_.sensors = available & all;
  return true;
}

Place ScheduledEstimator::place_of(const linear_model::OperatingPoint& flight) const noexcept {
  const engine_sim::RamRatios ram = engine_sim::ram_ratios(flight.altitude_m, flight.mach, flight.delta_isa_k);
  const int n1 = model_->lookup.schedule().fan_speed_state;
  return {x_(n1) / std::sqrt(ram.theta), flight.mach, ram.theta, ram.delta, flight.altitude_m};
}

double ScheduledEstimator::distance(const Conditions& conditions) const noexcept {
  Place place = place_of(conditions.flight);
  if (!std::isfinite(place.theta)) return std::numeric_limits<double>::infinity();
  // Before the first sample nobody knows the speed; it is found, or the estimate says that it does not hold.
  for (const Axis& axis : model_->lookup.schedule().axes)
    if (!begun_ && axis.variable == Variable::n1_corrected) place.n1_corrected_rpm = axis.points.front();
  return model_->lookup.outside(place) / cells_beyond;
}

estimation::SensorSpan ScheduledEstimator::span() const noexcept {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  estimation::SensorSpan span{SensorVector::Constant(sensors_, infinity), SensorVector::Constant(sensors_, -infinity)};
  const Schedule& schedule = model_->lookup.schedule();
  // Corrected readings of all nodes, at the least and greatest pressure and temperature that engines fly in.
  constexpr double delta[] = {0.2, 1.2}, theta[] = {0.75, 1.2};
  for (const Node& node : schedule.nodes)
    for (Eigen::Index i = 0; node.valid && i < sensors_; ++i)
      for (const double d : delta)
        for (const double t : theta) {
          const Similarity& s = schedule.sensors[as_size(i)];
          const double y = node.y0(i) * std::pow(d, s.delta_power) * std::pow(t, s.theta_power);
          span.least(i) = std::min(span.least(i), y);
          span.greatest(i) = std::max(span.greatest(i), y);
        }
  return span;
}

StateVector ScheduledEstimator::rates() const noexcept {
  StateVector f = point_.A * (x_ - point_.x0) + point_.B * (u_ - point_.u0);
  f += point_.L * xi_.segment(states_, health_) + model_->state_scale.cwiseProduct(xi_.segment(first_bias(), states_));
  return f;
}

void ScheduledEstimator::predict(const Conditions&, int steps) noexcept {
  if (!begun_) return;
  for (int k = 0; k < std::min(steps, longest_gap_samples); ++k) step(model_->options.sample_time_s);
  if (steps > longest_gap_samples) p_.diagonal().head(states_).array() += square(unmeasured_percent);
}

void ScheduledEstimator::step(double dt_s) noexcept {
  const ScheduledOptions& o = model_->options;
  const StateVector f = rates();
  x_ += dt_s * f + 0.5 * dt_s * dt_s * (point_.A * f);
  const auto scale = model_->state_scale.asDiagonal();
  const auto unscale = model_->state_scale.cwiseInverse().asDiagonal();
  // Phi in percent: [I + dt A + dt^2/2 A^2, S L, S, 0],  S = dt (I + dt/2 A)
  const StateMatrix a = unscale * point_.A * scale;
  const StateMatrix sum = dt_s * (StateMatrix::Identity(states_, states_) + 0.5 * dt_s * a);
  estimation::BoundedMatrix<estimation::max_states, max_unknowns> top;
  top.setZero(states_, p_.rows());
  top.leftCols(states_) = sum * a;
  top.middleCols(states_, health_) = sum * (unscale * point_.L);
  top.middleCols(first_bias(), states_) = sum;
  for (Eigen::Index i = 0; i < states_; ++i) top(i, i) += 1.0;
  const auto moved = (top * p_).eval();
  const auto own = (moved * top.transpose()).eval();
  p_.topRows(states_) = moved;
  p_.leftCols(states_) = moved.transpose();
  p_.topLeftCorner(states_, states_) = 0.5 * (own + own.transpose());
  const double steps = dt_s / nominal_step_s;
  p_.diagonal().head(states_).array() += steps * square(o.speed_walk_percent);
  p_.diagonal().segment(states_, health_).array() += steps * square(o.health_walk_percent);
  const double memory = std::exp(-std::exchange(path_, 0.0));
  if (memory == 1.0) return;
  const Eigen::Index biases = states_ + sensors_;
  xi_.tail(biases) *= memory;
  p_.bottomRows(biases) *= memory;
  p_.rightCols(biases) *= memory;
  p_.diagonal().tail(biases) += (1.0 - memory * memory) * bias_variance();
}

/// Of what the present node misses of rates and readings.
ScheduledEstimator::UnknownVector ScheduledEstimator::bias_variance() const noexcept {
  UnknownVector lambda(states_ + sensors_);
  lambda << point_.lambda_x.cwiseQuotient(model_->state_scale), point_.lambda_y.cwiseQuotient(model_->sensor_scale);
  return (model_->lookup.schedule().bias_factor * lambda).cwiseAbs2();
}

/// Finds the engine's place from its measured speeds, else from the first actuator, its fuel flow.
bool ScheduledEstimator::start(const SensorVector& y, const Conditions& now) noexcept {
  const int n1 = model_->lookup.schedule().fan_speed_state;
  const auto measured = [&](Eigen::Index state) {
    const int sensor = model_->sensor_of_state[as_size(state)];
    const bool there = sensor >= 0 && estimate_.sensors[as_size(sensor)] && std::isfinite(y(sensor)) && y(sensor) > 0.0;
    return there ? y(sensor) : std::numeric_limits<double>::quiet_NaN();
  };
  x_.setZero(states_);
  Place place = place_of(now.flight);
  place.n1_corrected_rpm = measured(n1) / std::sqrt(place.theta);
  if (!std::isfinite(place.n1_corrected_rpm))
    place.n1_corrected_rpm = model_->lookup.n1_of_actuator(0, now.actuators(0), place);
  if (!model_->lookup.at(place, point_)) return false;
  for (Eigen::Index i = 0; i < states_; ++i) {
    const double known = measured(i);
    x_(i) = std::isfinite(known) ? known : point_.x0(i);
    if (i == n1 && !std::isfinite(known)) x_(i) = place.n1_corrected_rpm * std::sqrt(place.theta);
    p_(i, i) = square(std::isfinite(known) ? measured_percent : unmeasured_percent);
  }
  return true;
}

void ScheduledEstimator::innovate(const SensorVector& y, const Conditions& now) noexcept {
  const bool first = !begun_;
  u_ = now.actuators;
  const bool answer = (!first || start(y, now)) && model_->lookup.at(place_of(now.flight), point_);
  if (!answer) {
    innovation_.value.setZero();
    innovation_.variance.setConstant(std::numeric_limits<double>::infinity());
    estimate_.holds = false;
    if (++lost_ * model_->options.sample_time_s > longest_without_answer_s && begun_) {
      reset();
      estimate_.holds = false;
    }
    return;
  }
  begun_ = true;
  lost_ = 0;
  estimate_.holds = true;
  if (first) p_.diagonal().tail(states_ + sensors_) = bias_variance();
  follow_path(place_of(now.flight), first);
  predict_readings(first);
  innovation_.value = y - lagged_;
  for (Eigen::Index i = 0; i < sensors_; ++i) {
    const UnknownVector c = slopes(i);
    innovation_.variance(i) = square(model_->sensor_scale(i)) * (c.dot(p_ * c) + noise_of(i));
    innovation_.noise(i) = square(reading_sigma(i));
  }
}

void ScheduledEstimator::follow_path(const Place& place, bool first) noexcept {
  const Schedule& s = model_->lookup.schedule();
  const double now = std::log(std::max(1.0, place.n1_corrected_rpm));
  if (first) log_n1_lagged_ = now;
  log_n1_lagged_ += (1.0 - std::exp(-model_->options.sample_time_s / metal_lag_s)) * (now - log_n1_lagged_);
  eta_ = now - log_n1_lagged_;
  const double moved =
      std::hypot((place.n1_corrected_rpm - n1_corrected_rpm_) / s.path_n1_rpm, (place.mach - mach_) / s.path_mach);
  if (first || moved > least_move) {  // noise of the estimate is no movement
    if (!first) path_ += moved;
    n1_corrected_rpm_ = place.n1_corrected_rpm;
    mach_ = place.mach;
  }
  teach_ = place.n1_corrected_rpm >= model_->options.least_n1_corrected_rpm;
}

void ScheduledEstimator::predict_readings(bool first) noexcept {
  SensorVector y = point_.y0 + point_.C * (x_ - point_.x0) + point_.D * (u_ - point_.u0);
  y += point_.M * xi_.segment(states_, health_) + model_->sensor_scale.cwiseProduct(xi_.tail(sensors_));
  for (Eigen::Index i = 0; i < sensors_; ++i) {
    const double lag_s = model_->lag_s(i);
    const double gain = first || lag_s <= 0.0 ? 1.0 : 1.0 - std::exp(-model_->options.sample_time_s / lag_s);
    lagged_(i) += gain * (y(i) - lagged_(i));
  }
}

/// Of a reading by the unknowns, percent by percent.
ScheduledEstimator::UnknownVector ScheduledEstimator::slopes(Eigen::Index i) const noexcept {
  UnknownVector c = UnknownVector::Zero(p_.rows());
  c.head(states_) = point_.C.row(i).transpose().cwiseProduct(model_->state_scale) / model_->sensor_scale(i);
  c.segment(states_, health_) = point_.M.row(i).transpose() / model_->sensor_scale(i);
  c(first_bias() + states_ + i) = 1.0;
  return c;
}

/// Standard deviation of a single reading's noise, sensor units.
double ScheduledEstimator::reading_sigma(Eigen::Index i) const noexcept {
  const double reading =
      model_->noise_of_reading && model_->trim(i) != 0.0 ? std::abs(lagged_(i) / model_->trim(i)) : 1.0;
  return model_->noise(i) * reading;
}

double ScheduledEstimator::noise_of(Eigen::Index i) const noexcept {
  const ScheduledOptions& o = model_->options;
  const double sigma = reading_sigma(i) / model_->sensor_scale(i);
  const double early = o.early_gain_percent * p_.diagonal().segment(states_, health_).sum() / fleet_trace_;
  const double of_reading = 0.01 * std::abs(lagged_(i)) / model_->sensor_scale(i);
  const double transient = model_->lookup.schedule().eta_y(i) * 100.0 * eta_ * of_reading;
  return square(sigma) + square(early) * nominal_step_s / o.sample_time_s +
         square(transient) * (1.0 + 2.0 * metal_lag_s / o.sample_time_s);
}

void ScheduledEstimator::update(SensorMask fused, std::int64_t) noexcept {
  if (!estimate_.holds || !begun_) return;
  UnknownVector change = UnknownVector::Zero(p_.rows());
  for (Eigen::Index i = 0; i < sensors_; ++i) {
    if (!(fused & estimate_.sensors)[as_size(i)]) continue;
    const UnknownVector c = slopes(i);
    const UnknownVector g = p_ * c;
    const double s = c.dot(g) + noise_of(i);
    const double innovation = innovation_.value(i) / model_->sensor_scale(i) - c.dot(change);
    if (teach_) {
      const UnknownVector half = g / std::sqrt(s);
      p_.noalias() -= half * half.transpose();
      change += g * (innovation / s);
      continue;
    }
    UnknownVector k = g / s;  // the rest is only held: Schmidt's consider filter
    k.tail(k.size() - states_).setZero();
    p_ -= (k * g.transpose() + g * k.transpose() - s * k * k.transpose()).eval();
    change += k * innovation;
  }
  ++samples_;
  const StateVector most = largest_state_percent * model_->state_scale;
  x_ =
      (x_ + model_->state_scale.cwiseProduct(change.head(states_))).cwiseMax(0.01 * model_->state_scale).cwiseMin(most);
  const Eigen::Index others = p_.rows() - states_;
  xi_.tail(others) += change.tail(others);
  auto health = xi_.segment(states_, health_);
  health = health.cwiseMax(-largest_health_percent).cwiseMin(largest_health_percent);
  read_out();
}

void ScheduledEstimator::widen(double excess) noexcept {
  if (excess == excess_) return;
  const double ratio = std::sqrt(excess / excess_);
  excess_ = excess;
  estimate_.health_sigma *= ratio;
  estimate_.auxiliary_sigma *= ratio;
}

void ScheduledEstimator::read_out() noexcept {
  estimate_.health = model_->health_scale.cwiseProduct(xi_.segment(states_, health_));
  estimate_.health_sigma_filter =
      model_->health_scale.cwiseProduct(p_.diagonal().segment(states_, health_).cwiseMax(0.0).cwiseSqrt());
  estimate_.health_sigma = std::sqrt(excess_) * estimate_.health_sigma_filter;
  estimate_.settled = samples_ * model_->options.sample_time_s >= settling_time_s;
  if (!begun_) return;
  const Schedule& s = model_->lookup.schedule();
  estimate_.auxiliary = point_.z0 + point_.F * (x_ - point_.x0) + point_.G * (u_ - point_.u0);
  estimate_.auxiliary += point_.N * xi_.segment(states_, health_);
  for (Eigen::Index i = 0; i < estimate_.auxiliary.size(); ++i) {
    UnknownVector c = UnknownVector::Zero(p_.rows());
    c.head(states_) = point_.F.row(i).transpose().cwiseProduct(model_->state_scale);
    c.segment(states_, health_) = point_.N.row(i).transpose();
    const double own = c.dot(p_ * c);
    estimate_.auxiliary_sigma_filter(i) = std::sqrt(std::max(0.0, own));
    estimate_.auxiliary_sigma(i) =
        std::sqrt(excess_ * (std::max(0.0, own) + square(s.bias_factor * point_.lambda_z(i)) +
                             square(s.eta_z(i) * 100.0 * eta_)));
  }
}

}  // namespace ehm::schedule
