// SPDX-License-Identifier: Apache-2.0
#include "monitor/cycle/monitor_cycle.h"

#include <cmath>
#include <limits>

#include "deploy/runtime/numbers/index.h"
#include "idl/wire_values.h"
#include "monitor/checks/innovation_gate.h"

namespace ehm::monitor {

namespace reason = idl::reject_reason;

namespace {
constexpr double metal_settles_s = 75.0;  // three times 25 s, the slowest metal (theory.md, section 13)
}

MonitorCycle::MonitorCycle(const PreparedDesign& prepared, const CycleOptions& options)
    : design_(prepared.design),
      options_(options),
      sensors_(static_cast<int>(design_->model.sensors.size())),
      actuators_(static_cast<int>(design_->model.controls.size())),
      watch_(prepared.tuner, {options.validity, design_->model}),
      companions_(prepared.companions),
      configured_(prepared.published),
      published_(prepared.published),
      shadows_(prepared.shadows),
      resting_(prepared.companions.size()),
      intake_(options, design_->model),
      supervision_(options, design_->model, prepared.span(prepared.published)),
      accommodation_(*design_),
      fleet_(options.fleet, design_->model, prepared.fleet),
      detection_(options, prepared),
      limits_(options.limits, design_->model) {
  for (const Companion& companion : prepared.companions) spans_.push_back(companion.span);
  result_.shadow.resize(shadows_.size());
  no_residuals();
}

bool MonitorCycle::estimate(const Sample& sample) noexcept {
  ++counters_.received;
  const SampleDecision decision = intake_.decide(sample, counters_, events_);
  if (!in_order(decision.verdict)) return false;
  if (decision.verdict == SampleVerdict::restarted) restart(decision.reason, decision.jump_s);
  intake_.take(sample, decision, counters_, events_);
  now_ = conditions_of(intake_.sample());
  if (decision.verdict != SampleVerdict::accepted) before_ = now_;
  steps_ = decision.steps;
  supervision_.check(sample, steps_, result_, events_);

  const bool was_at_point = at_point_;
  const bool usable = intake_.usable(decision, events_);
  distance_ = distance_of_published();
  valid_ = validity_.check(distance_, events_) && usable;
  at_point_ = watch_holds(was_at_point);
  if (was_at_point && !at_point_ && published_ != watch_filter) detection_.leave_point(events_);
  if (!at_point_) fallback_.end(events_);
  if (!valid_ || (!at_point_ && companions_.rests(as_size(published_)))) {
    companions_.rest(steps_);
    note_rest();
    withhold();
    return true;
  }
  if (!at_point_) {
    fuse_beyond_the_point();
    return true;
  }
  if (!was_at_point) restart_at_point();
  companions_.choose(true, now_, steps_);
  note_rest();
  const bool has_design = choose_design();
  fuse(has_design);
  conclude(has_design);
  return true;
}

/// Who flies through the point is not at it: the metal is hot or cold from elsewhere, and the watch filter, whose model
/// has none, would take that for a shift of health. It waits, while another estimator is there to be published.
bool MonitorCycle::watch_holds(bool was_at_point) noexcept {
  if (!point_.check(watch_.distance(now_)) || !valid_) {
    inside_s_ = 0.0;
    return false;
  }
  inside_s_ += steps_ * design_->model.sample_time_s;
  return was_at_point || published_ == watch_filter || inside_s_ >= metal_settles_s;
}

double MonitorCycle::distance_of_published() const noexcept {
  return published_ == watch_filter ? watch_.distance(now_) : companions_.distance(as_size(published_), now_);
}

/// Where the watch filter's model does not hold and the published estimator's does: that one judges the readings.
void MonitorCycle::fuse_beyond_the_point() noexcept {
  companions_.choose(false, now_, steps_);
  note_rest();
  const estimation::SensorMask in_use = supervision_.available();
  companions_.predict(in_use, before_, steps_);
  before_ = now_;
  estimation::SensorVector values = supervision_.values();
  for (int i = 0; i < sensors_; ++i)  // a value that was read before tells nothing of now
    if (result_.reason[as_size(i)] == reason::repeated) values(i) = std::numeric_limits<double>::quiet_NaN();
  companions_.innovate(values, now_);
  const estimation::Innovation& innovation = companions_.innovation(as_size(published_));
  result_.innovation = innovation.value;
  result_.innovation_variance = innovation.variance;
  const GateDecision gate = gate_beyond_the_point(in_use);
  result_.ratio = gate.ratio;
  if (estimate_of(published_).holds) bias_return_.look(innovation.value, innovation.variance);
  supervision_.gate(gate, {.held_back = bias_return_.sensor(), .loud = detection_.loud()}, result_);
  supervision_.qualify(false, result_, counters_, events_);
  note_fused(supervision_.available());
  companions_.update(result_.fused, supervision_.hold());
  take_estimates();
  compare_estimators();
  result_.estimates = result_.estimate.holds;
  ++(result_.estimates ? counters_.processed : counters_.withheld);
  result_.flags = estimate_flags();
}

/// Those in use among themselves; one that is left out by itself, so that it neither restrains nor excuses the others.
GateDecision MonitorCycle::gate_beyond_the_point(estimation::SensorMask in_use) const noexcept {
  const estimation::SensorMask plausible = supervision_.plausible(result_);
  GateDecision gate =
      innovation_gate(result_.innovation, result_.innovation_variance, plausible & in_use, options_.checks.gate_sigma);
  for (int i = 0; i < sensors_; ++i)
    if (plausible[as_size(i)] && !in_use[as_size(i)]) gate.rejected[as_size(i)] = gate.ratio(i) > 1.0;
  return gate;
}

void MonitorCycle::note_fused(estimation::SensorMask in_use) noexcept {
  for (int i = 0; i < sensors_; ++i) {
    const auto s = as_size(i);
    result_.fused[s] = result_.reason[s] == 0 && in_use[s];
    result_.rejected[s] = !result_.fused[s];
  }
}

void MonitorCycle::take_estimates() noexcept {
  // Who does not fly has an estimate of a sample that is gone.
  result_.estimate = estimate_of(published_);
  result_.estimate.holds = result_.estimate.holds && flies(published_);
  for (std::size_t i = 0; i < shadows_.size(); ++i) {
    result_.shadow[i] = estimate_of(shadows_[i]);
    result_.shadow[i].holds = result_.shadow[i].holds && flies(shadows_[i]);
  }
}

void MonitorCycle::compare_estimators() noexcept {
  if (companions_.size() == 0 || !result_.estimate.holds) return;
  companions_.compare(result_.estimate);
  if (at_point_) watch_tally_.compare(watch_.estimate(), result_.estimate);
}

/// For the sensors that are left; false if there is none.
bool MonitorCycle::choose_design() noexcept {
  const bool had_design = accommodation_.has_design();
  if (!accommodation_.find_design(watch_, supervision_, events_)) return false;
  if (!had_design) restart_filter();  // it ran blind in the meantime
  accommodation_.respond(verdict_, watch_, detection_);
  return true;
}

void MonitorCycle::fuse(bool has_design) noexcept {
  const Stopwatch now_ns = companions_.size() > 0 ? companions_.stopwatch() : nullptr;
  std::int64_t watch_ns = 0;
  // After a loss the actuators are taken as held, which is what they do between samples.
  companions_.predict(supervision_.available(), before_, steps_);
  {
    const Lap lap(now_ns, watch_ns);
    watch_.predict(before_, steps_);
    watch_.innovate(supervision_.values(), now_);
  }
  before_ = now_;
  result_.innovation = watch_.innovation().value;
  result_.innovation_variance = watch_.innovation().variance;

  const estimation::SensorMask plausible = supervision_.plausible(result_), in_use = watch_.filter().sensors();
  const double gate_sigma = options_.checks.gate_sigma;
  const GateDecision gate =
      innovation_gate(result_.innovation, result_.innovation_variance, plausible & in_use, gate_sigma);
  result_.ratio = gate.ratio;
  const int held_back = accommodation_.check_return(watch_, plausible, detection_.shifted(), gate_sigma, result_.ratio);
  supervision_.gate(gate,
                    {.held_back = held_back, .suspect = detection_.suspect(), .detector_listens = detection_.listens()},
                    result_);
  supervision_.qualify(detection_.listens(), result_, counters_, events_);

  note_fused(in_use);
  {
    const Lap lap(now_ns, watch_ns);
    watch_.update(result_.fused, supervision_.hold());
  }
  watch_tally_.count(watch_.estimate().holds, watch_ns);
  if (companions_.size() > 0) watch_tally_.look(watch_.innovation(), result_.fused);
  companions_.innovate(supervision_.values(), now_);
  companions_.update(result_.fused, supervision_.hold());
  if (!has_design) return;
  fleet_.check(watch_.estimate().tuners, watch_.estimate().health, watch_.filter().sensor_set().missing(), events_);
  watch_.widen(fleet_.excess());
  companions_.widen(fleet_.excess());
}

void MonitorCycle::conclude(bool has_design) noexcept {
  take_estimates();
  if (published_ != watch_filter && fallback_.look(result_.estimate.holds, events_))
    result_.estimate = watch_.estimate();
  compare_estimators();
  result_.estimates = has_design && result_.estimate.holds && !fleet_.withheld();
  ++(result_.estimates ? counters_.processed : counters_.withheld);
  if (!result_.estimates)
    for (int i = 0; i < sensors_; ++i) result_.reason[as_size(i)] |= reason::withheld;
  result_.flags = estimate_flags();
}

void MonitorCycle::diagnose() noexcept {
  if (!valid_) return;
  if (!at_point_) {
    if (!companions_.flies(as_size(published_))) return;
    const int sensor = detection_.follow(result_.estimate, companions_.innovation(as_size(published_)), supervision_,
                                         result_, events_);
    if (sensor >= 0) bias_return_.leave_out(sensor, result_.estimate.bias, result_.estimate.least_bias);
    if (result_.estimates) limits_.check(result_.estimate.health, result_.estimate.auxiliary, events_);
    return;
  }
  const bool has_design = accommodation_.has_design();
  verdict_ = detection_.diagnose(watch_, has_design, steps_, supervision_, result_, events_);
  if (has_design) limits_.check(result_.estimate.health, result_.estimate.auxiliary, events_);
}

}  // namespace ehm::monitor
