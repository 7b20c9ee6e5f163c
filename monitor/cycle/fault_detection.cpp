// SPDX-License-Identifier: Apache-2.0
#include "monitor/cycle/fault_detection.h"

#include <algorithm>
#include <cmath>

#include "deploy/runtime/numbers/index.h"
#include "idl/wire_values.h"

namespace ehm::monitor {

namespace reason = idl::reject_reason;

namespace {
constexpr double ambiguity_lasts_s = 5.0;  // after the evidence has faded
constexpr double return_settles_in = 2.0;  // slowest time constants after a sensor has come back
}  // namespace

FaultDetection::FaultDetection(const CycleOptions& options, const PreparedDesign& prepared)
    : sample_time_s_(prepared.design->model.sample_time_s),
      slowest_time_constant_s_(prepared.design->full.slowest_time_constant_s),
      detector_(options.faults, prepared.faults, sample_time_s_),
      published_noise_(options.faults.false_alarm_per_hour, static_cast<int>(prepared.design->model.sensors.size()),
                       sample_time_s_),
      shift_(options.shift, *prepared.design, prepared.shift),
      slow_bias_(options.faults, prepared.slow_bias) {}

Verdict FaultDetection::diagnose(const estimation::TunerEstimator& watch, bool has_design, int steps,
                                 SensorSupervision& supervision, CycleResult& result, EventList& events) noexcept {
  const estimation::TunerFilter& filter = watch.filter();
  const bool all_sensors = filter.sensor_set().is_full(), settled = watch.estimate().settled;
  const bool slow_start = supervision.hold() > 1 && !settled;
  estimation::SensorMask present;
  for (Eigen::Index i = 0; i < result.innovation.size(); ++i)
    present[as_size(i)] = (result.reason[as_size(i)] & ~reason::innovation_gate) == 0;
  present &= filter.sensors();
  ungated_.step(filter, present, result.fused);
  Verdict verdict;
  if (has_design && !slow_start)
    verdict = declare(detector_.step(ungated_.innovation(), present, steps), all_sensors, supervision, result, events);
  settle_ambiguity(false, events);
  if (!has_design) {
    shift_.reset();
    return verdict;
  }
  const bool wait = detector_.pending() || ambiguous_.raised() || verdict.fault.kind != FaultKind::none || slow_start;
  shift_.check(filter.tuners(), filter.sensor_set().missing(), wait, events);
  if (all_sensors && settled) slow_bias_.check(filter.tuners(), events);
  return verdict;
}

Verdict FaultDetection::declare(const FaultVerdict& fault, bool all_sensors, SensorSupervision& supervision,
                                CycleResult& result, EventList& events) noexcept {
  const auto channel = static_cast<std::uint32_t>(fault.channel);
  switch (fault.kind) {
    case FaultKind::none:
      break;
    case FaultKind::sensor_bias:
    case FaultKind::sensor_noise:
      settle_ambiguity(true, events);
      return declare_sensor(fault, all_sensors, supervision, result, events);
    case FaultKind::component_step:
      settle_ambiguity(true, events);
      shift_.name({.kind = idl::EventKind::health_shift,
                   .channel = channel,
                   .raised = true,
                   .value = fault.size,
                   .threshold = fault.noticeable,
                   .age_s = age_s(fault)},
                  events);
      break;
    case FaultKind::ambiguous:
      ambiguous_channel_ = channel;
      unambiguous_samples_ = 0;
      ambiguous_.set(true,
                     {.kind = idl::EventKind::ambiguous_fault,
                      .channel = channel,
                      .value = fault.size,
                      .threshold = fault.noticeable,
                      .age_s = age_s(fault)},
                     events);
      break;
  }
  return {};
}

Verdict FaultDetection::declare_sensor(const FaultVerdict& fault, bool all_sensors, SensorSupervision& supervision,
                                       CycleResult& result, EventList& events) noexcept {
  const bool bias = fault.kind == FaultKind::sensor_bias;
  const std::uint32_t why = bias ? reason::bias : reason::noise;
  const Event event{.kind = idl::EventKind::sensor_fault,
                    .channel = static_cast<std::uint32_t>(fault.channel),
                    .raised = true,
                    .value = fault.size,
                    .threshold = fault.noticeable,
                    .detail = why,
                    .age_s = bias ? age_s(fault) : 0.0};
  if (bias && all_sensors && slow_bias_.ended_by(fault.channel, fault.size)) {
    Event end = event;
    end.kind = idl::EventKind::slow_bias;
    end.raised = false;
    events.push(end);
    return {fault, true};
  }
  supervision.exclude(fault.channel, event, events);
  result.reason[as_size(fault.channel)] |= why | reason::excluded;
  return {fault, false};
}

void FaultDetection::settle_ambiguity(bool decided, EventList& events) noexcept {
  if (!ambiguous_.raised()) return;
  unambiguous_samples_ = detector_.excited() ? 0 : unambiguous_samples_ + 1;
  const bool over = decided || static_cast<double>(unambiguous_samples_) * sample_time_s_ > ambiguity_lasts_s;
  ambiguous_.set(!over, {.kind = idl::EventKind::ambiguous_fault, .channel = ambiguous_channel_}, events);
}

void FaultDetection::leave_point(EventList& events) noexcept {
  published_noise_.start();
  loud_.reset();
  shift_.end(events);
  ambiguous_.reassess(idl::EventKind::ambiguous_fault, ambiguous_channel_, events);
}

/// Differences of innovations hold the noise of two readings and hardly anything else, however wide the doubt is.
void FaultDetection::follow_noise(const estimation::Innovation& innovation, SensorSupervision& supervision,
                                  CycleResult& result, EventList& events) noexcept {
  const estimation::SensorVector& noise = innovation.noise.size() > 0 ? innovation.noise : innovation.variance;
  const estimation::SensorVector scaled = innovation.value.cwiseQuotient(noise.cwiseSqrt());
  estimation::SensorMask present;
  for (Eigen::Index i = 0; i < scaled.size(); ++i) present[as_size(i)] = std::isfinite(scaled(i));
  published_noise_.step(scaled, present);
  for (int i = 0; i < static_cast<int>(scaled.size()); ++i) {
    const auto s = as_size(i);
    loud_[s] = present[s] && published_noise_.loud(i);
    if (!loud_[s] || supervision.excluded(i)) continue;
    supervision.exclude(i,
                        {.kind = idl::EventKind::sensor_fault,
                         .channel = static_cast<std::uint32_t>(i),
                         .raised = true,
                         .value = published_noise_.factor(i),
                         .threshold = published_noise_.threshold_factor(),
                         .detail = reason::noise},
                        events);
    result.reason[s] |= reason::noise | reason::excluded;
  }
}

namespace {

/// Ends the condition of a channel that is found no more, then raises that of the one that is; found -1: none.
void follow_channel(Condition& condition, std::uint32_t& channel, int found, Event event, EventList& events) noexcept {
  const auto now = static_cast<std::uint32_t>(std::max(found, 0));
  if (condition.raised() && (found < 0 || now != channel))
    condition.set(false, {.kind = event.kind, .channel = channel}, events);
  if (found < 0) return;
  channel = event.channel = now;
  condition.set(true, event, events);
}

}  // namespace

int FaultDetection::follow(const estimation::Estimate& published, const estimation::Innovation& innovation,
                           SensorSupervision& supervision, CycleResult& result, EventList& events) noexcept {
  if (published.holds) follow_noise(innovation, supervision, result, events);
  follow_channel(published_step_, stepped_channel_, published.stepped,
                 {.kind = idl::EventKind::health_shift, .value = published.step, .threshold = published.least_step},
                 events);
  follow_channel(ambiguous_, ambiguous_channel_, published.suspected,
                 {.kind = idl::EventKind::ambiguous_fault, .value = published.bias, .threshold = published.least_bias},
                 events);
  const int sensor = published.biased;
  if (sensor < 0 || supervision.excluded(sensor)) return -1;
  supervision.exclude(sensor,
                      {.kind = idl::EventKind::sensor_fault,
                       .channel = static_cast<std::uint32_t>(sensor),
                       .raised = true,
                       .value = published.bias,
                       .threshold = published.least_bias,
                       .detail = reason::bias},
                      events);
  result.reason[as_size(sensor)] |= reason::bias | reason::excluded;
  return sensor;
}

void FaultDetection::restart(int missing, EventList& events) noexcept {
  published_noise_.start();
  loud_.reset();
  if (missing < 0)
    detector_.reset();
  else
    detector_.start(missing, detector_.tables().of(missing).settling_samples);
  ungated_.reset();
  shift_.reset();
  slow_bias_.reset(events);
  published_step_.reassess(idl::EventKind::health_shift, stepped_channel_, events);
  ambiguous_.reassess(idl::EventKind::ambiguous_fault, ambiguous_channel_, events);
}

void FaultDetection::resume(int missing, Eigen::Index deaf_samples) noexcept {
  shift_.reset();
  ungated_.reset();
  detector_.start(missing, deaf_samples);
}

void FaultDetection::without(int sensor) noexcept {
  ungated_.reset();
  detector_.change_set(sensor, 0);
}

/// It listens once what was wrong with the shift has died away.
void FaultDetection::with_all() noexcept {
  ungated_.reset();
  const double settle_s = return_settles_in * slowest_time_constant_s_;
  detector_.change_set(-1, std::llround(settle_s / sample_time_s_));
}

}  // namespace ehm::monitor
