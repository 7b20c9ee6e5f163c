// SPDX-License-Identifier: Apache-2.0
// What happens to a cycle beside its samples: starts, ends, silence, what it withholds. Real-time safe: yes, all of it.

#include <cmath>

#include "deploy/runtime/numbers/index.h"
#include "idl/wire_names.h"
#include "monitor/cycle/monitor_cycle.h"

namespace ehm::monitor {

namespace reason = idl::reject_reason;

namespace {
constexpr double rest_s = 10.0;  // of an estimator that has overrun its budget
}

void MonitorCycle::restart_filter() noexcept {
  companions_.reset();
  restart_watch();
}

/// The engine is back where the watch filter's model holds: what has flown on meanwhile goes on.
void MonitorCycle::restart_at_point() noexcept {
  companions_.reset_idle();
  restart_watch();
}

void MonitorCycle::restart_watch() noexcept {
  bias_return_.forget();
  detection_.restart(accommodation_.start(watch_, supervision_), events_);
  fleet_.reset(events_);
  verdict_ = {};
  before_ = now_;
}

void MonitorCycle::restart(RestartReason reason, double jump_s) noexcept {
  ++counters_.restarts;
  if (reason != RestartReason::command) {
    intake_.forget_words(events_);
    supervision_.forget_values();
  }
  if (sensors_are_new(reason)) {
    supervision_.forget(events_);
    accommodation_.forget(events_);
  }
  restart_filter();
  events_.push({.kind = idl::EventKind::filter_restart,
                .raised = true,
                .value = jump_s,
                .threshold = options_.checks.restart_gap_s,
                .detail = static_cast<std::uint32_t>(reason)});
}

void MonitorCycle::reset(RestartReason reason) noexcept {
  restart(reason, 0.0);
  intake_.reset(events_);
}

void MonitorCycle::retire() noexcept {
  reset(RestartReason::other_design);
  fallback_.end(events_);
  for (std::size_t i = 0; i < resting_.size(); ++i)
    resting_[i].end_with_design(idl::EventKind::estimator_overrun, overrun_of(i, 0.0, 0.0).channel, events_);
  validity_.end_with_design(events_);
  limits_.end_with_design(events_);
  supervision_.retire(events_);
  intake_.retire(events_);
}

Publishing MonitorCycle::publish(std::string_view name) noexcept {
  const int wanted = name == design::tuner_name ? watch_filter : companions_.find(name);
  if (wanted == watch_filter && name != design::tuner_name) return Publishing::not_flying;
  if (wanted == published_) return Publishing::already;
  if (!result_.estimates || stale() || !flies(wanted) || !estimate_of(wanted).holds) return Publishing::no_answer;
  fallback_.end(events_);
  published_ = wanted;
  supervision_.use(wanted == watch_filter ? estimation::SensorSpan{} : spans_[as_size(wanted)]);
  events_.push({.kind = idl::EventKind::estimator_chosen,
                .channel = static_cast<std::uint32_t>(idl::estimator_number(name)),
                .raised = true});
  return Publishing::done;
}

std::string_view MonitorCycle::published() const noexcept {
  return name_of(published_);
}

void MonitorCycle::rest(std::size_t companion, double took_us, double budget_us) noexcept {
  companions_.send_to_rest(companion, static_cast<int>(std::lround(rest_s / design_->model.sample_time_s)));
  resting_[companion].set(true, overrun_of(companion, took_us, budget_us), events_);
}

Event MonitorCycle::overrun_of(std::size_t companion, double took_us, double budget_us) const noexcept {
  return {.kind = idl::EventKind::estimator_overrun,
          .channel = static_cast<std::uint32_t>(idl::estimator_number(companions_.tally(companion).name)),
          .value = took_us,
          .threshold = budget_us};
}

void MonitorCycle::note_rest() noexcept {
  for (std::size_t i = 0; i < resting_.size(); ++i)
    if (resting_[i].raised()) resting_[i].set(companions_.rests(i), overrun_of(i, 0.0, 0.0), events_);
}

bool MonitorCycle::usable(const Sample& sample) const noexcept {
  if (intake_.malformed(sample)) return false;
  for (int i = 0; i < sensors_; ++i)
    if (sample.sensor_valid >> i & 1u && std::isfinite(sample.sensor[as_size(i)])) return true;
  return false;
}

bool MonitorCycle::no_input(double age_s) noexcept {
  const double limit_s = options_.stale_periods * design_->model.sample_time_s;
  if (age_s <= limit_s) return false;
  intake_.lost(age_s, limit_s, events_);
  return true;
}

estimation::Conditions MonitorCycle::conditions_of(const Sample& sample) const noexcept {
  estimation::Conditions conditions{sample.flight, estimation::ActuatorVector(actuators_)};
  for (int i = 0; i < actuators_; ++i) conditions.actuators(i) = sample.actuator[as_size(i)];
  return conditions;
}

void MonitorCycle::no_residuals() noexcept {
  result_.innovation.setZero(sensors_);
  result_.innovation_variance.setZero(sensors_);
  result_.ratio.setZero(sensors_);
}

void MonitorCycle::withhold() noexcept {
  ++counters_.withheld;
  no_residuals();
  result_.estimates = false;
  result_.fused.reset();
  result_.rejected.reset();
  for (int i = 0; i < sensors_; ++i) {
    result_.rejected.set(as_size(i));
    result_.reason[as_size(i)] |= reason::withheld;
  }
  result_.flags = estimate_flags();
}

std::uint32_t MonitorCycle::estimate_flags() const noexcept {
  namespace flag = idl::estimate_flag;
  std::uint32_t flags = 0;
  const bool beyond = valid_ && !at_point_;
  if (!(beyond ? result_.estimate : watch_.estimate()).settled) flags |= flag::converging;
  estimation::SensorMask served = result_.fused;
  for (int i = 0; i < sensors_; ++i)
    if (result_.reason[as_size(i)] == reason::repeated) served.set(as_size(i));
  const estimation::SensorMask in_use = beyond ? result_.estimate.sensors : watch_.filter().sensors();
  if ((served & in_use) != in_use || intake_.replaced() > 0) flags |= flag::bridging;
  if (beyond ? static_cast<int>(in_use.count()) < sensors_ : !watch_.filter().sensor_set().is_full())
    flags |= flag::degraded;
  if (!valid_) flags |= flag::off_design;
  if (beyond ? result_.estimate.stepped >= 0 : detection_.shifted()) flags |= flag::shifted;
  if (!beyond && fleet_.implausible()) flags |= flag::implausible;
  if (fallback_.fallen()) flags |= flag::fallback;
  return flags;
}

}  // namespace ehm::monitor
