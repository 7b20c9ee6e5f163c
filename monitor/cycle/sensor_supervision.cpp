// SPDX-License-Identifier: Apache-2.0
#include "monitor/cycle/sensor_supervision.h"

#include <algorithm>
#include <limits>

#include "deploy/runtime/numbers/index.h"
#include "idl/wire_values.h"

namespace ehm::monitor {

namespace reason = idl::reject_reason;

SensorSupervision::SensorSupervision(const CycleOptions& options, const linear_model::LinearModel& model,
                                     const estimation::SensorSpan& span)
    : options_(options.checks),
      sample_time_s_(model.sample_time_s),
      sensors_(static_cast<int>(model.sensors.size())),
      sensor_check_(options.checks, options.sensors, model, span),
      qualification_(model.sensors.size()),
      gated_(model.sensors.size()),
      sensor_fault_(model.sensors.size()),
      slow_sensor_(model.sensors.size()),
      values_(estimation::SensorVector::Zero(sensors_)) {}

void SensorSupervision::check(const Sample& sample, int steps, CycleResult& result, EventList& events) noexcept {
  for (int i = 0; i < sensors_; ++i) {
    const auto s = as_size(i);
    result.reason[s] = sensor_check_.reasons(sample, i, steps);
    const bool present = !(result.reason[s] & (reason::source_invalid | reason::not_finite));
    values_(i) = present ? sample.sensor[s] : std::numeric_limits<double>::quiet_NaN();
  }
  watch_holds(events);
}

/// A slow sensor that the design takes for a fast one: each value is fused once, so that its noise counts once. Its
/// share of the filter is slower by as much, and so are the error that is published and those who wait for it.
void SensorSupervision::watch_holds(EventList& events) noexcept {
  hold_ = 1;
  for (int i = 0; i < sensors_; ++i) {
    const std::int64_t hold = sensor_check_.untold_hold(i);
    hold_ = std::max(hold_, hold);
    slow_sensor_[as_size(i)].set(hold > 1,
                                 {.kind = idl::EventKind::slow_sensor,
                                  .channel = static_cast<std::uint32_t>(i),
                                  .value = sample_time_s_ * static_cast<double>(hold),
                                  .threshold = sample_time_s_},
                                 events);
  }
}

estimation::SensorMask SensorSupervision::plausible(const CycleResult& result) const noexcept {
  estimation::SensorMask plausible;
  for (int i = 0; i < sensors_; ++i)
    if (result.reason[as_size(i)] == 0) plausible.set(as_size(i));
  return plausible;
}

void SensorSupervision::gate(const GateDecision& gate, const GateContext& context, CycleResult& result) noexcept {
  const estimation::SensorMask plausible = this->plausible(result);
  for (int i = 0; i < sensors_; ++i) {
    const auto s = as_size(i);
    // The gate keeps wild values out. What lasts longer is the fault detector's to name, once it listens.
    if (result.reason[s] != reason::repeated) gated_[s] = gate.rejected[s] ? gated_[s] + 1 : 0;
    const bool suspect = plausible[s] && context.suspect == i;
    const bool wild = gate.rejected[s] && (!context.detector_listens || gated_[s] <= options_.bridge_samples);
    if (wild || suspect || context.held_back == i || (context.loud[s] && excluded(i)))
      result.reason[s] |= reason::innovation_gate;
  }
}

/// What the event of a sensor's exclusion compares: the range of its values, how many are equal, or the gate's ratio.
std::pair<double, double> SensorSupervision::evidence(int sensor, const CycleResult& result) const noexcept {
  const std::uint32_t why = result.reason[as_size(sensor)];
  if (why & reason::quiet) return {sensor_check_.quiet(sensor).range(), sensor_check_.quiet(sensor).least()};
  if (!(why & reason::stuck)) return {result.ratio(sensor), 1.0};
  const StuckWatch& stuck = sensor_check_.stuck(sensor);
  return {static_cast<double>(stuck.run()), static_cast<double>(stuck.limit())};
}

void SensorSupervision::qualify(bool detector_listens, CycleResult& result, CycleCounters& counters,
                                EventList& events) noexcept {
  for (int i = 0; i < sensors_; ++i) {
    const auto s = as_size(i);
    const std::uint32_t why = result.reason[s];
    if (why == reason::repeated) {  // no news, neither good nor bad
      if (excluded(i)) result.reason[s] |= reason::excluded;
      continue;
    }
    const bool only_wild = why == reason::innovation_gate && detector_listens && !excluded(i);
    const bool out = qualification_[s].observe(why == 0 || only_wild, options_) == Qualification::State::excluded;
    const auto [value, limit] = evidence(i, result);
    sensor_fault_[s].set(out,
                         {.kind = idl::EventKind::sensor_fault,
                          .channel = static_cast<std::uint32_t>(i),
                          .value = value,
                          .threshold = limit,
                          .detail = why},
                         events);
    if (out) result.reason[s] |= reason::excluded;
    counters.sensor_rejections += result.reason[s] != 0;
  }
}

estimation::SensorMask SensorSupervision::available() const noexcept {
  estimation::SensorMask available;
  for (int i = 0; i < sensors_; ++i) available[as_size(i)] = !excluded(i);
  return available;
}

void SensorSupervision::exclude(int sensor, const Event& event, EventList& events) noexcept {
  const auto s = as_size(sensor);
  qualification_[s].exclude();
  sensor_fault_[s].set(true, event, events);
}

void SensorSupervision::forget(EventList& events) noexcept {
  for (auto& q : qualification_) q.reset();
  for (std::size_t i = 0; i < sensor_fault_.size(); ++i)
    sensor_fault_[i].reassess(idl::EventKind::sensor_fault, static_cast<std::uint32_t>(i), events);
}

void SensorSupervision::retire(EventList& events) noexcept {
  for (std::size_t i = 0; i < slow_sensor_.size(); ++i)
    slow_sensor_[i].end_with_design(idl::EventKind::slow_sensor, static_cast<std::uint32_t>(i), events);
}

}  // namespace ehm::monitor
