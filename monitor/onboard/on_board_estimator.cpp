// SPDX-License-Identifier: Apache-2.0
#include "monitor/onboard/on_board_estimator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine_sim/model/parts/inlet.h"
#include "engine_sim/model/units.h"
#include "monitor/onboard/start_motion.h"

namespace ehm::onboard {
namespace {

namespace sim = engine_sim;
using estimation::Conditions;
using estimation::SensorMask;
using estimation::SensorVector;

constexpr double nominal_step_s = 0.015;
constexpr double largest_health_percent = 25.0;
constexpr double measured_speed_sigma = 1.0, unmeasured_speed_sigma = 5.0;  ///< percent, at the start
constexpr int longest_gap_samples = 8;
constexpr double least_move = 0.03;  ///< of a path length
constexpr double most_soak = 0.7;    ///< of the metal's conductance and capacity
/// How far the metal may be from where a start puts it: a whole slam, K.
constexpr double metal_doubt_k = 50.0;
constexpr double longest_without_answer_s = 1.0, settling_time_s = 60.0;
constexpr double step_lasts_s = 60.0;  ///< after it was found
constexpr double sure = 0.9;           ///< probability from which on a sensor is named

double square(double x) {
  return x * x;
}

}  // namespace

OnBoardEstimator::OnBoardEstimator(std::shared_ptr<const OnBoardModel> model)
    : model_(std::move(model)),
      layout_(*model_),
      tangent_(model_),
      prior_(learned_nothing(*model_)),
      covariance_(layout_),
      steps_(layout_, model_->options()),
      fleet_trace_(prior_.covariance.diagonal().head(layout_.health_count).sum()) {
  for (Eigen::Index i = 0; i < layout_.sensor_count; ++i) estimate_.sensors.set(as_size(i));
  reset();
}

std::unique_ptr<estimation::Estimator> OnBoardEstimator::clone() const {
  return std::make_unique<OnBoardEstimator>(model_);
}

void OnBoardEstimator::reset() noexcept {
  metal_known_ = false;
  start_cold();
}

void OnBoardEstimator::start_cold() noexcept {
  tangent_.forget();
  xi_.setZero(layout_.count());
  xi_.segment(UnknownLayout::first_health(), prior_.value.size()) = prior_.value;
  set_metal();
  covariance_.start(prior_.covariance);
  moved_.setZero(layout_.count());
  rates_.setZero();
  lagged_.setZero(layout_.sensor_count);
  noise_.setOnes(layout_.sensor_count);
  doubt_.noise.setOnes(layout_.sensor_count);
  doubt_.slow.setZero(layout_.sensor_count);
  steps_.reset();
  forget_findings();
  size_.setOnes(layout_.sensor_count);
  innovation_.value.setZero(layout_.sensor_count);
  innovation_.variance.setZero(layout_.sensor_count);
  estimate_.auxiliary.setZero(layout_.auxiliary_count);
  estimate_.tuners.resize(0);
  path_ = 0.0;
  lost_ = 0;
  begun_ = teach_ = false;
  estimate_.holds = true;
  samples_ = 0;
  excess_ = 1.0;
  read_out(UnknownVector::Zero(layout_.count()));
}

Learned OnBoardEstimator::learned() const noexcept {
  const Eigen::Index first = UnknownLayout::first_health(), n = layout_.health_count + layout_.cause_count;
  return {xi_.segment(first, n), covariance_.matrix().block(first, first, n, n)};
}

bool OnBoardEstimator::begin_with(const Learned& known, double wear_percent) noexcept {
  if (known.value.size() != prior_.value.size() || known.covariance.rows() != prior_.covariance.rows() ||
      known.covariance.cols() != prior_.covariance.cols())
    return false;
  prior_ = after_wear(known, *model_, wear_percent);
  reset();
  return true;
}

/// What is misread stays what it was and becomes as uncertain as if it were drawn anew around that: nothing jumps.
void OnBoardEstimator::next_flight(double wear_percent) noexcept {
  prior_ = after_wear(learned(), *model_, wear_percent);
  UnknownVector opened = UnknownVector::Zero(prior_.value.size());
  opened.head(layout_.health_count).setConstant(square(wear_percent));
  for (std::size_t i = 0; i < model_->causes().size(); ++i)
    if (model_->causes()[i].kind == CauseKind::input) opened(layout_.health_count + as_index(i)) = 1.0;
  covariance_.open(UnknownLayout::first_health(), opened);
}

bool OnBoardEstimator::use(SensorMask available) noexcept {
  SensorMask all;
  for (Eigen::Index i = 0; i < layout_.sensor_count; ++i) all.set(as_size(i));
  if ((available & all).none()) return false;
  estimate_.sensors = available & all;
  for (int* sensor : {&estimate_.biased, &estimate_.suspected})
    if (*sensor >= 0 && !available[as_size(*sensor)]) *sensor = -1;  // it is left out now
  return true;
}

sim::Operation OnBoardEstimator::operation_of(const Conditions& now) const noexcept {
  sim::Operation operation{.flight = {now.flight.altitude_m, now.flight.mach, now.flight.delta_isa_k}};
  const auto& channels = model_->definition().channels;
  for (std::size_t i = 0; i < channels.controls.size(); ++i)
    channels.controls[i]->of(operation) = now.actuators(as_index(i));
  for (std::size_t i = 0; i < channels.health.size(); ++i)
    operation.health[channels.health[i].parameter] = 0.01 * xi_(UnknownLayout::first_health() + as_index(i));
  return operation;
}

void OnBoardEstimator::predict(const Conditions&, int steps) noexcept {
  if (!begun_) return;
  const double dt_s = model_->options().sample_time_s;
  for (int k = 0; k < std::min(steps, longest_gap_samples); ++k) step(dt_s);
  if (steps <= longest_gap_samples) return;
  // Nobody knows what the engine did meanwhile; its speeds will be measured.
  covariance_.open(0, UnknownVector::Constant(speed_count, square(unmeasured_speed_sigma)));
}

void OnBoardEstimator::step(double dt_s) noexcept {
  const OnBoardOptions& o = model_->options();
  const sim::SpoolSpeeds& design = model_->engine().data().design.speeds;
  const Eigen::Matrix2d f = tangent_.speed_rates();
  const Eigen::Vector2d change = dt_s * rates_ + 0.5 * dt_s * dt_s * f * rates_;
  motion_.speeds.n1_rpm += 0.01 * change(0) * design.n1_rpm;
  motion_.speeds.n2_rpm += 0.01 * change(1) * design.n2_rpm;
  tangent_.advance_metal(dt_s, motion_);
  metal_doubt_k_ *= std::exp(-dt_s / model_->soak_time_s());
  rates_ += f * change;
  const double steps = dt_s / nominal_step_s, memory = std::exp(-std::exchange(path_, 0.0));
  covariance_.predict(tangent_, {.dt_s = dt_s,
                                 .speed_variance = steps * square(o.speed_walk_percent),
                                 .health_variance = steps * square(o.health_walk_percent),
                                 .memory = memory});
  xi_.tail(layout_.sensor_count) *= memory;
}

void OnBoardEstimator::innovate(const SensorVector& y, const Conditions& now) noexcept {
  const sim::Operation operation = operation_of(now);
  const bool first = !begun_;
  estimate_.holds = (begun_ || start(y, operation)) && tangent_.answer(operation, motion_);
  if (!estimate_.holds) return lose();
  lost_ = 0;
  begun_ = true;
  if (first) covariance_.open(layout_.first_bias(), tangent_.path_variance());
  follow_path(operation, first);
  predict_readings(first);
  weigh_readings();
  innovation_.value = y - lagged_;
  innovation_.noise = size_.cwiseAbs2().cwiseProduct(doubt_.noise);
  for (Eigen::Index i = 0; i < layout_.sensor_count; ++i)
    innovation_.variance(i) =
        square(size_(i)) * (covariance_.variance(tangent_.readings().row(i).transpose()) + noise_(i));
}

bool OnBoardEstimator::start(const SensorVector& y, const sim::Operation& operation) noexcept {
  std::array<double, speed_count> measured;
  UnknownVector variance(speed_count);
  for (int k = 0; k < speed_count; ++k) {
    const int sensor = model_->speed_sensor(k);
    const bool known = sensor >= 0 && estimate_.sensors[static_cast<std::size_t>(sensor)] && y(sensor) > 0.0;
    measured[static_cast<std::size_t>(k)] = known ? y(sensor) : std::numeric_limits<double>::quiet_NaN();
    variance(k) = square(known ? measured_speed_sigma : unmeasured_speed_sigma);
  }
  const auto motion = start_motion(*model_, operation, measured, tangent_.engine());
  if (!motion) return false;
  const auto metal_k = motion_.metal_k;
  motion_ = *motion;
  set_metal();
  if (metal_known_) motion_.metal_k = metal_k;  // a start in flight: it is no more in balance than it was
  metal_known_ = true;
  metal_doubt_k_ = metal_doubt_k;
  covariance_.open(0, variance);
  return true;
}

void OnBoardEstimator::lose() noexcept {
  innovation_.value.setZero();
  innovation_.variance.setConstant(std::numeric_limits<double>::infinity());
  if (++lost_ * model_->options().sample_time_s > longest_without_answer_s && begun_) start_cold();
  estimate_.holds = false;
}

/// Adds to the path that the biases forget by, and sees whether the engine stands where it teaches.
void OnBoardEstimator::follow_path(const sim::Operation& operation, bool first) noexcept {
  const OnBoardOptions& o = model_->options();
  const double root_theta = std::sqrt(tangent_.gas().s2.tt_k / sim::reference_temperature_k);
  const double n1_corrected_rpm = motion_.speeds.n1_rpm / root_theta, mach = operation.flight.mach;
  const double moved =
      std::hypot((n1_corrected_rpm - n1_corrected_rpm_) / (o.path_length_n1 * model_->design_n1_corrected_rpm()),
                 (mach - mach_) / o.path_length_mach);
  if (first || moved > least_move) {  // noise of the estimate is no movement
    if (!first) path_ += moved;
    n1_corrected_rpm_ = n1_corrected_rpm;
    mach_ = mach;
  }
  teach_ = n1_corrected_rpm >= o.least_n1 * model_->design_n1_corrected_rpm();
}

void OnBoardEstimator::predict_readings(bool first) noexcept {
  const auto& sensors = model_->definition().channels.sensors;
  const Eigen::Index known = layout_.cause_count + layout_.sensor_count;
  const SensorVector y = tangent_.readings_of(tangent_.gas());
  size_ = 0.01 * y;
  UnknownVector beside = xi_.tail(known);
  beside.head(layout_.cause_count) = linear_causes();
  const SensorVector predicted = y + size_.cwiseProduct(tangent_.readings().rightCols(known) * beside);
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const auto at = as_index(i);
    const double gain =
        first || sensors[i].lag_s <= 0.0 ? 1.0 : 1.0 - std::exp(-model_->options().sample_time_s / sensors[i].lag_s);
    lagged_(at) += gain * (predicted(at) - lagged_(at));
  }
}

void OnBoardEstimator::weigh_readings() noexcept {
  const OnBoardOptions& o = model_->options();
  const double early = o.early_gain_percent * covariance_.health_trace() / fleet_trace_;
  const double correlated = 1.0 + 2.0 * model_->soak_time_s() / o.sample_time_s;
  const SensorVector soak = o.soak_error * (tangent_.metal_readings() * tangent_.soak_k());
  const SensorVector doubt = metal_doubt_k_ * tangent_.metal_readings().rowwise().norm();
  for (Eigen::Index i = 0; i < layout_.sensor_count; ++i) {
    const double noise = square(model_->noise_sigma(as_size(i), lagged_(i)) / size_(i)),
                 metal = square(soak(i)) + square(doubt(i));
    doubt_.noise(i) = noise;
    doubt_.slow(i) = square(o.step_floor_percent) + metal;
    noise_(i) = noise + square(early) * nominal_step_s / o.sample_time_s + metal * correlated;
  }
}

void OnBoardEstimator::update(SensorMask fused, std::int64_t) noexcept {
  if (!estimate_.holds) return;
  watch_for_steps(fused);
  UnknownVector change = UnknownVector::Zero(layout_.count());
  for (Eigen::Index i = 0; i < layout_.sensor_count; ++i) {
    if (!(fused & estimate_.sensors)[as_size(i)]) continue;
    const UnknownVector row = tangent_.readings().row(i).transpose();
    const double innovation = innovation_.value(i) / size_(i) - row.dot(change);
    change += covariance_.update(row, noise_(i), teach_) * innovation;
  }
  ++samples_;
  move_by(change);
  moved_ = change;
  read_out(change);
}

void OnBoardEstimator::watch_for_steps(SensorMask fused) noexcept {
  const double dt_s = model_->options().sample_time_s;
  if (static_cast<double>(++since_step_) * dt_s > step_lasts_s) forget_findings();
  if (!teach_ || !estimate_.settled) return steps_.reset();  // P is open by itself
  const estimation::Innovation percent{innovation_.value.cwiseQuotient(size_),
                                       innovation_.variance.cwiseQuotient(size_.cwiseAbs2()), doubt_.noise};
  if (steps_.take(percent, estimate_.sensors, fused, tangent_, covariance_, doubt_)) open_for_step();
}

void OnBoardEstimator::forget_findings() noexcept {
  estimate_.stepped = estimate_.biased = estimate_.suspected = -1;
}

void OnBoardEstimator::open_for_step() noexcept {
  const StepFinding& found = steps_.finding();
  const auto& health = model_->definition().channels.health;
  UnknownVector variance(layout_.health_count);
  for (std::size_t j = 0; j < health.size(); ++j)
    variance(as_index(j)) = found.health(as_index(j)) * square(100.0 * health[j].sigma);
  covariance_.open(UnknownLayout::first_health(), variance);
  covariance_.open(layout_.first_bias(), square(model_->options().step_bias_percent) * found.sensor);
  ++steps_found_;
  since_step_ = 0;
  forget_findings();
  if (found.parameter < 0) {
    Eigen::Index sensor = 0;
    const bool named = found.sensor.maxCoeff(&sensor) >= sure;
    (named ? estimate_.biased : estimate_.suspected) = static_cast<int>(sensor);
    estimate_.bias = found.size_percent * size_(sensor);
    estimate_.least_bias = found.threshold_percent * size_(sensor);
    return;
  }
  estimate_.stepped = static_cast<int>(found.parameter);
  estimate_.step = 0.01 * found.size_percent;
  estimate_.least_step = 0.01 * found.threshold_percent;
}

void OnBoardEstimator::move_by(const UnknownVector& change) noexcept {
  const UnknownVector before = linear_causes();
  shift_unknowns(change);
  rates_ = tangent_.rates_of(tangent_.gas()) + tangent_.rates() * change +
           tangent_.rates().middleCols(layout_.first_cause(), layout_.cause_count) * before;
  set_metal();
}

void OnBoardEstimator::shift_unknowns(const UnknownVector& change) noexcept {
  const sim::SpoolSpeeds& design = model_->engine().data().design.speeds;
  motion_.speeds.n1_rpm += 0.01 * change(0) * design.n1_rpm;
  motion_.speeds.n2_rpm += 0.01 * change(1) * design.n2_rpm;
  const Eigen::Index others = layout_.count() - speed_count;
  xi_.tail(others) += change.tail(others);
  auto health = xi_.segment(UnknownLayout::first_health(), layout_.health_count);
  health = health.cwiseMax(-largest_health_percent).cwiseMin(largest_health_percent);
}

/// The causes that the model does not hold itself, and zeros.
UnknownVector OnBoardEstimator::linear_causes() const noexcept {
  UnknownVector linear = causes();
  for (std::size_t i = 0; i < model_->causes().size(); ++i)
    if (of_metal(model_->causes()[i].kind)) linear(as_index(i)) = 0.0;
  return linear;
}

void OnBoardEstimator::set_metal() noexcept {
  for (std::size_t i = 0; i < model_->causes().size(); ++i) {
    const OnBoardCause& cause = model_->causes()[i];
    if (!of_metal(cause.kind)) continue;
    const double value =
        1.0 + std::clamp(cause.sigma * xi_(layout_.first_cause() + as_index(i)), -most_soak, most_soak);
    (cause.kind == CauseKind::conductance ? motion_.conductance : motion_.capacity) = value;
  }
}

void OnBoardEstimator::widen(double excess) noexcept {
  if (excess == excess_) return;
  const double ratio = std::sqrt(excess / excess_);
  excess_ = excess;
  estimate_.health_sigma *= ratio;
  estimate_.auxiliary_sigma *= ratio;
}

/// `change`: by which the update moved the unknowns from where the engine answered.
void OnBoardEstimator::read_out(const UnknownVector& change) noexcept {
  const Eigen::Index p = layout_.health_count;
  estimate_.health = 0.01 * xi_.segment(UnknownLayout::first_health(), p);
  estimate_.health_sigma_filter =
      0.01 * covariance_.matrix().diagonal().segment(UnknownLayout::first_health(), p).cwiseSqrt();
  estimate_.health_sigma = std::sqrt(excess_) * estimate_.health_sigma_filter;
  estimate_.settled = samples_ * model_->options().sample_time_s >= settling_time_s;
  const auto& z = tangent_.outputs();
  estimate_.auxiliary_sigma.setZero(layout_.auxiliary_count);
  estimate_.auxiliary_sigma_filter = estimate_.auxiliary_sigma;
  if (!begun_) return;
  UnknownVector from_answer = change;
  for (std::size_t i = 0; i < model_->causes().size(); ++i) {
    const Eigen::Index at = layout_.first_cause() + as_index(i);
    if (!of_metal(model_->causes()[i].kind)) from_answer(at) = xi_(at);
  }
  estimate_.auxiliary = tangent_.outputs_of(tangent_.gas()) + z * from_answer;
  const estimation::AuxiliaryVector soak =
      model_->options().soak_error * (tangent_.metal_outputs() * tangent_.soak_k());
  for (Eigen::Index i = 0; i < layout_.auxiliary_count; ++i) {
    const double own = covariance_.variance(z.row(i).transpose());
    estimate_.auxiliary_sigma_filter(i) = std::sqrt(own);
    estimate_.auxiliary_sigma(i) =
        std::sqrt(excess_ * (own + tangent_.path_output_variance()(i) + square(soak(i)) +
                             square(metal_doubt_k_ * tangent_.metal_outputs().row(i).norm())));
  }
}

double OnBoardEstimator::distance(const Conditions& conditions) const noexcept {
  // Wherever the atmosphere is known; where the engine has no answer the estimate says so (holds), and it tries again.
  const sim::FlightCondition flight{conditions.flight.altitude_m, conditions.flight.mach,
                                    conditions.flight.delta_isa_k};
  return sim::covers(flight) ? 0.0 : 2.0;
}

void OnBoardEstimator::save(estimation::EstimatorState& state) const noexcept {
  state = {};
  state.learned = learned();
}

bool OnBoardEstimator::restore(const estimation::EstimatorState& state) noexcept {
  return begin_with(state.learned, 0.0);
}

}  // namespace ehm::onboard
