// SPDX-License-Identifier: Apache-2.0
#include "monitor/checks/sensor_check.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/scaling.h"
#include "engine_sim/linear_model/sensor_noise.h"
#include "idl/wire_values.h"
#include "monitor/estimation/steady_gain.h"

namespace ehm::monitor {

namespace reason = idl::reject_reason;

namespace {

constexpr double spreads_of_range = 10.0;  ///< in a hundredth of the range's scale: 60 % leave six

void require_known(const std::vector<SensorOptions>& sensors, const linear_model::LinearModel& model) {
  for (const SensorOptions& option : sensors) {
    std::string names;
    bool known = false;
    for (const auto& channel : model.sensors) {
      known = known || channel.name == option.name;
      names += ' ' + channel.name;
    }
    if (!known)
      throw std::invalid_argument("sensor.name is '" + option.name + "', which the design does not have; it has" +
                                  names);
  }
}

}  // namespace

SensorKind sensor_kind(const CheckOptions& options, const std::vector<SensorOptions>& sensors,
                       const linear_model::LinearModel& model, std::size_t sensor) {
  const auto i = as_index(sensor);
  SensorKind kind{.noise_sigma = linear_model::own_sigma(model, i),
                  .resolution = linear_model::resolution(model, i),
                  .update_samples = 0,
                  .least = options.stuck_samples};
  if (model.sensor_update_period_s.size() > 0 && model.sensor_update_period_s(i) > 0.0)
    kind.update_samples = linear_model::held_samples(model, i);
  for (const SensorOptions& option : sensors) {
    if (option.name != model.sensors[sensor].name) continue;
    if (option.resolution >= 0.0) kind.resolution = option.resolution;
    kind.operators_limit = option.stuck_samples;
  }
  return kind;
}

SensorCheck::SensorCheck(const CheckOptions& options, const std::vector<SensorOptions>& sensors,
                         const linear_model::LinearModel& model, const estimation::SensorSpan& span)
    : options_(options),
      least_(model.sensors.size()),
      greatest_(model.sensors.size()),
      memory_(model.sensors.size()),
      quiet_(model.sensors.size()) {
  require_known(sensors, model);
  // sqrt of diag(H Ph H^T): what the fleet's health makes of each sensor
  const Eigen::VectorXd spread = (estimation::steady_gain(model).H * model.health_sigma.asDiagonal()).rowwise().norm();
  for (std::size_t i = 0; i < model.sensors.size(); ++i) {
    const auto at = as_index(i);
    percent_.push_back(std::max({linear_model::percent_of_trim(model.sensors[i], 0.0), model.sensor_noise_sigma(at),
                                 spread(at) / spreads_of_range}));
    trim_.push_back(model.sensors[i].trim);
    const SensorKind kind = sensor_kind(options, sensors, model, i);
    stuck_.emplace_back(kind);
    may_be_quiet_.push_back(kind.operators_limit != 0);
    told_.push_back(kind.update_samples > 0);
  }
  use(span);
}

void SensorCheck::use(const estimation::SensorSpan& span) noexcept {
  for (std::size_t i = 0; i < trim_.size(); ++i) {
    const auto at = as_index(i);
    const bool spanned = at < span.least.size() && span.least(at) <= span.greatest(at);
    const double least = spanned ? std::min(trim_[i], span.least(at)) : trim_[i];
    const double greatest = spanned ? std::max(trim_[i], span.greatest(at)) : trim_[i];
    least_[i] = least - options_.range_percent * percent_[i];
    greatest_[i] = greatest + options_.range_percent * percent_[i];
  }
}

std::uint32_t SensorCheck::reasons(const Sample& sample, int sensor, int steps) noexcept {
  const auto i = as_size(sensor);
  Memory& memory = memory_[i];
  StuckWatch& stuck = stuck_[i];
  const double value = sample.sensor[i];
  if (!(sample.sensor_valid >> sensor & 1u)) return reason::source_invalid;
  if (!std::isfinite(value)) return reason::not_finite;

  std::uint32_t reasons = 0;
  if (value < least_[i] || value > greatest_[i]) reasons |= reason::range;
  // A sensor that speaks every n samples has moved for n.
  const double since = static_cast<double>(std::max<std::int64_t>(1, steps) * stuck.hold());
  if (memory.has_last && std::abs(value - memory.last) > options_.rate_percent * percent_[i] * since)
    reasons |= reason::rate;
  memory.last = value;
  memory.has_last = true;
  if (reasons != 0) return reasons;  // says nothing of how a healthy sensor repeats itself

  stuck.take(value, steps);
  if (stuck.fresh() && may_be_quiet_[i]) quiet_[i].take(value);
  if (stuck.frozen()) return reason::stuck;
  if (quiet_[i].frozen()) return reason::stuck | reason::quiet;
  return stuck.fresh() ? 0 : reason::repeated;
}

void SensorCheck::reset() noexcept {
  std::fill(memory_.begin(), memory_.end(), Memory{});
  for (StuckWatch& stuck : stuck_) stuck.restart();
  for (QuietWatch& quiet : quiet_) quiet.restart();
}

}  // namespace ehm::monitor
