#include "monitor/cycle/monitor_cycle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "idl/wire_values.h"

namespace ehm::monitor {

namespace reason = idl::reject_reason;
using estimation::SensorSet;

namespace {

template <class Vector>
Vector trims(const std::vector<linear_model::Channel>& channels) {
  Vector trim(static_cast<Eigen::Index>(channels.size()));
  for (std::size_t i = 0; i < channels.size(); ++i) trim(static_cast<Eigen::Index>(i)) = channels[i].trim;
  return trim;
}

}  // namespace

MonitorCycle::MonitorCycle(const PreparedDesign& prepared, const CycleOptions& options)
    : design_(prepared.design),
      options_(options),
      sensors_(static_cast<int>(design_->model.sensors.size())),
      actuators_(static_cast<int>(design_->model.controls.size())),
      error_models_(prepared.error_models),
      filter_(prepared.filter),
      error_(error_models_->front()),
      sample_check_(options.checks, sensors_, actuators_, design_->model.sample_time_s),
      sample_time_(design_->model.sample_time_s),
      stamp_watch_(design_->model.sample_time_s),
      sequence_watch_(design_->model.sample_time_s),
      condition_check_(options.checks, design_->model),
      sensor_check_(options.checks, options.sensors, design_->model),
      qualification_(static_cast<std::size_t>(sensors_)),
      gated_(static_cast<std::size_t>(sensors_)),
      validity_(options.validity, design_->model),
      faults_(options.faults, prepared.faults, design_->model.sample_time_s),
      shift_(options.shift, *design_, prepared.shift),
      slow_bias_(options.faults, prepared.slow_bias),
      fleet_(options.fleet, design_->model, prepared.fleet),
      limits_(options.limits, design_->model),
      dy_(sensors_),
      sensor_trim_(trims<estimation::SensorVector>(design_->model.sensors)),
      du_(actuators_),
      du_previous_(actuators_),
      actuator_trim_(trims<estimation::ActuatorVector>(design_->model.controls)),
      sensor_fault_(static_cast<std::size_t>(sensors_)),
      slow_sensor_(static_cast<std::size_t>(sensors_)),
      second_source_(design_->model.sample_time_s) {
  no_residuals();
}

bool MonitorCycle::estimate(const Sample& sample) noexcept {
  ++counters_.received;
  SampleDecision decision;
  if (!admit(sample, decision)) return false;
  steps_ = decision.steps;
  check_sensors(sample, decision.steps);
  const bool was_valid = valid_;
  const bool in_time = sample_time_.judge(decision, events_);
  valid_ = validity_.judge(mended_, events_) && in_time && usable_;
  if (!valid_) {
    withhold();
    return true;
  }
  if (!was_valid) restart_filter();
  choose_design();
  predict();
  gate();
  qualify();
  update();
  conclude();
  return true;
}

bool MonitorCycle::usable(const Sample& sample) const noexcept {
  if (sample_check_.malformed(sample)) return false;
  for (int i = 0; i < sensors_; ++i)
    if (sample.sensor_valid >> i & 1u && std::isfinite(sample.sensor[static_cast<std::size_t>(i)])) return true;
  return false;
}

void MonitorCycle::judge() noexcept {
  if (!valid_) return;
  detect();
  if (!have_design_) return shift_.reset();
  const bool wait = faults_.pending() || ambiguous_.raised() || declared_.kind != FaultKind::none || slow_start();
  shift_.judge(filter_.tuners(), filter_.sensor_set().missing(), wait, events_);
  if (filter_.sensor_set().is_full() && error_.settled()) slow_bias_.judge(filter_.tuners(), events_);
  limits_.judge(filter_.health(), filter_.auxiliary(), events_);
}

bool MonitorCycle::admit(const Sample& sample, SampleDecision& decision) noexcept {
  decision = sample_check_.decide(sample);
  counters_.lost += decision.lost;
  dropped_ |= 1u << static_cast<unsigned>(decision.verdict);
  switch (decision.verdict) {
    case SampleVerdict::malformed:
      ++counters_.malformed;
      return false;
    case SampleVerdict::duplicate:
      ++counters_.duplicated;
      sequence_watch_.repeated(sample, events_);
      return false;
    case SampleVerdict::reordered:
      ++counters_.reordered;
      return false;
    case SampleVerdict::foreign:
      ++counters_.foreign;
      second_source_.foreign(sample, sample_check_.source_id(), events_);
      return false;
    case SampleVerdict::restarted:
      restart(decision.reason, decision.jump_s);
      break;
    case SampleVerdict::first:
    case SampleVerdict::accepted:
      break;
  }
  input_lost_.set(false, {idl::EventKind::input_lost, 0, false, 0.0, 0.0, 0}, events_);
  second_source_.followed(decision.steps, events_);
  sequence_watch_.in_order(sample, events_);
  stamp_watch_.judge(decision, events_);
  dropped_ = 0;
  mended_ = sample;
  usable_ = condition_check_.mend(mended_, decision.steps, events_);
  counters_.sensor_rejections += condition_check_.replaced();
  for (int i = 0; i < actuators_; ++i) du_(i) = mended_.actuator[static_cast<std::size_t>(i)] - actuator_trim_(i);
  if (decision.verdict != SampleVerdict::accepted) du_previous_ = du_;
  return true;
}

void MonitorCycle::restart_filter() noexcept {
  filter_.reset();
  error_.reset(error_models_->front());
  int missing = -1;
  if (excluded_sensors(missing) == 1 && filter_.switch_sensor_set(SensorSet::without(missing))) {
    error_.reset((*error_models_)[static_cast<std::size_t>(1 + missing)]);
    faults_.start(missing, faults_.tables().of(missing).settling_samples);
    cold_return_ = true;
    await_return(missing);
  } else {
    faults_.reset();
  }
  ungated_.reset();
  shift_.reset();
  slow_bias_.reset(events_);
  fleet_.reset(events_);
  ambiguous_.judge_anew(idl::EventKind::ambiguous_fault, ambiguous_channel_, events_);
  declared_ = {};
  du_previous_ = du_;
}

/// What the gate knows of this sensor stays; of another one's it would be wrong.
void MonitorCycle::await_return(int sensor) noexcept {
  if (gated_sensor_ == sensor) return;
  const double variance = filter_.innovation_variance()(sensor);
  return_gate_.start(0.0, variance, variance, 0.0);
  return_gate_.forget();
  gated_sensor_ = sensor;
}

void MonitorCycle::forget_sensors() noexcept {
  gated_sensor_ = -1;
  for (auto& q : qualification_) q.reset();
  for (std::size_t i = 0; i < sensor_fault_.size(); ++i)
    sensor_fault_[i].judge_anew(idl::EventKind::sensor_fault, static_cast<std::uint32_t>(i), events_);
  have_design_ = true;
  no_design_.judge_anew(idl::EventKind::no_design, 0, events_);
}

void MonitorCycle::restart(RestartReason reason, double jump_s) noexcept {
  ++counters_.restarts;
  if (reason != RestartReason::command) {
    condition_check_.reset(events_);
    sensor_check_.reset();
  }
  if (sensors_are_new(reason)) forget_sensors();
  restart_filter();
  events_.push({idl::EventKind::filter_restart, 0, true, jump_s, options_.checks.restart_gap_s,
                static_cast<std::uint32_t>(reason)});
}

void MonitorCycle::reset(RestartReason reason) noexcept {
  restart(reason, 0.0);
  sequence_watch_.end(events_);
  stamp_watch_.end(events_);
  sample_check_.reset();
}

void MonitorCycle::retire() noexcept {
  reset(RestartReason::other_design);
  sample_time_.end_with_design(events_);
  validity_.end_with_design(events_);
  limits_.end_with_design(events_);
  second_source_.end(events_);
  for (std::size_t i = 0; i < slow_sensor_.size(); ++i)
    slow_sensor_[i].end_with_design(idl::EventKind::slow_sensor, static_cast<std::uint32_t>(i), events_);
  input_lost_.end_with_design(idl::EventKind::input_lost, 0, events_);
}

void MonitorCycle::check_sensors(const Sample& sample, int steps) noexcept {
  for (int i = 0; i < sensors_; ++i) {
    const auto s = static_cast<std::size_t>(i);
    result_.reason[s] = sensor_check_.reasons(sample, i, steps);
    const bool present = !(result_.reason[s] & (reason::source_invalid | reason::not_finite));
    dy_(i) = present ? sample.sensor[s] - sensor_trim_(i) : std::numeric_limits<double>::quiet_NaN();
  }
  watch_holds();
}

/// A slow sensor that the design takes for a fast one: each value is fused once, so that its noise counts once. Its
/// share of the filter is slower by as much, and so are the error that is published and those who wait for it.
void MonitorCycle::watch_holds() noexcept {
  const double sample_time_s = design_->model.sample_time_s;
  slowness_ = 1;
  for (int i = 0; i < sensors_; ++i) {
    const std::int64_t hold = sensor_check_.untold_hold(i);
    slowness_ = std::max(slowness_, hold);
    slow_sensor_[static_cast<std::size_t>(i)].set(hold > 1,
                                                  {idl::EventKind::slow_sensor, static_cast<std::uint32_t>(i), false,
                                                   sample_time_s * static_cast<double>(hold), sample_time_s, 0},
                                                  events_);
  }
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
    result_.rejected.set(static_cast<std::size_t>(i));
    result_.reason[static_cast<std::size_t>(i)] |= reason::withheld;
  }
  result_.flags = estimate_flags();
}

void MonitorCycle::predict() noexcept {
  // After a loss the actuators are taken as held, which is what they do between samples.
  for (int k = 1; k < steps_; ++k) {
    filter_.predict(du_previous_);
    filter_.update({});  // a lost sample fuses nothing
  }
  filter_.predict(du_previous_);
  du_previous_ = du_;
  filter_.innovation(dy_, du_);
}

void MonitorCycle::gate() noexcept {
  estimation::SensorMask plausible;
  for (int i = 0; i < sensors_; ++i)
    if (result_.reason[static_cast<std::size_t>(i)] == 0) plausible.set(static_cast<std::size_t>(i));
  result_.innovation = filter_.innovation();
  result_.innovation_variance = filter_.innovation_variance().cwiseMax(error_.innovation_variance());
  const GateDecision in_use = innovation_gate(result_.innovation, result_.innovation_variance,
                                              plausible & filter_.sensors(), options_.checks.gate_sigma);
  result_.ratio = in_use.ratio;
  // Without a design there is no prediction worth comparing with: the checks alone requalify.
  const int missing = filter_.sensor_set().missing();
  if (have_design_ && missing >= 0) {
    return_gate_.step(design_->model.sample_time_s);
    if (plausible[static_cast<std::size_t>(missing)]) return_gate_.observe(filter_.innovation()(missing));
    if (shift_.raised()) return_gate_.forget();
    result_.ratio(missing) = return_gate_.ratio(filter_.innovation()(missing), options_.checks.gate_sigma);
    cold_return_ = cold_return_ && !error_.settled();
  }
  for (int i = 0; i < sensors_; ++i) {
    const auto s = static_cast<std::size_t>(i);
    const bool held_back = have_design_ && i == missing && plausible[s] && (cold_return_ || result_.ratio(i) > 1.0);
    // The gate keeps wild values out. What lasts longer is the fault detector's to name, once it listens.
    if (result_.reason[s] != reason::repeated) gated_[s] = in_use.rejected[s] ? gated_[s] + 1 : 0;
    const bool suspect = plausible[s] && faults_.suspect() == i;
    const bool wild = in_use.rejected[s] && (!faults_.armed() || gated_[s] <= options_.checks.bridge_samples);
    if (wild || suspect || held_back) result_.reason[s] |= reason::innovation_gate;
  }
}

/// What the event of a sensor's exclusion compares: the range of its values, how many are equal, or the gate's ratio.
std::pair<double, double> MonitorCycle::evidence(int sensor, std::uint32_t why) const noexcept {
  if (why & reason::quiet) return {sensor_check_.quiet(sensor).range(), sensor_check_.quiet(sensor).least()};
  if (!(why & reason::stuck)) return {result_.ratio(sensor), 1.0};
  const StuckWatch& stuck = sensor_check_.stuck(sensor);
  return {static_cast<double>(stuck.run()), static_cast<double>(stuck.limit())};
}

void MonitorCycle::qualify() noexcept {
  for (int i = 0; i < sensors_; ++i) {
    const auto s = static_cast<std::size_t>(i);
    const std::uint32_t why = result_.reason[s];
    if (why == reason::repeated) {  // no news, neither good nor bad
      if (qualification_[s].state() == Qualification::State::excluded) result_.reason[s] |= reason::excluded;
      continue;
    }
    const bool only_wild = why == reason::innovation_gate && faults_.armed() &&
                           qualification_[s].state() != Qualification::State::excluded;
    const bool excluded =
        qualification_[s].observe(why == 0 || only_wild, options_.checks) == Qualification::State::excluded;
    const auto [value, limit] = evidence(i, why);
    sensor_fault_[s].set(
        excluded, {idl::EventKind::sensor_fault, static_cast<std::uint32_t>(i), false, value, limit, why}, events_);
    if (excluded) result_.reason[s] |= reason::excluded;
    counters_.sensor_rejections += result_.reason[s] != 0;
  }
}

void MonitorCycle::update() noexcept {
  result_.fused.reset();
  result_.rejected.reset();
  for (int i = 0; i < sensors_; ++i) {
    const auto s = static_cast<std::size_t>(i);
    const bool fuse = result_.reason[s] == 0 && filter_.sensors()[s];
    result_.fused[s] = fuse;
    result_.rejected[s] = !fuse;
  }
  filter_.update(result_.fused);
  if (++slow_samples_ < slowness_) return;
  slow_samples_ = 0;
  error_.step();
}

/// Of those that a design needs; `last` is one of them.
int MonitorCycle::excluded_sensors(int& last) const noexcept {
  int excluded = 0;
  const estimation::SensorMask wanted = filter_.model().full.sensors;
  for (int i = 0; i < sensors_; ++i) {
    const auto s = static_cast<std::size_t>(i);
    if (wanted[s] && qualification_[s].state() == Qualification::State::excluded) ++excluded, last = i;
  }
  return excluded;
}

void MonitorCycle::choose_design() noexcept {
  int missing = -1;
  const int excluded = excluded_sensors(missing);
  const bool had_design = have_design_;
  have_design_ = excluded == 0 || (excluded == 1 && filter_.available(SensorSet::without(missing)));
  no_design_.set(!have_design_, {idl::EventKind::no_design, 0, false, static_cast<double>(excluded), 1.0, 0}, events_);
  if (!have_design_) return;
  if (!had_design) restart_filter();  // it ran blind in the meantime
  if (declared_.kind != FaultKind::none && came_back_) follow_return();

  if (filter_.sensor_set().missing() == missing) return;
  if (!filter_.sensor_set().is_full()) readmit();
  if (missing >= 0) exclude(missing);
}

void MonitorCycle::conclude() noexcept {
  if (have_design_) {
    fleet_.judge(filter_.tuners(), filter_.health(), filter_.sensor_set().missing(), events_);
    error_.widen(fleet_.excess());
  }
  result_.sensors_used = filter_.sensors();
  result_.estimates = have_design_ && !fleet_.withheld();
  ++(result_.estimates ? counters_.processed : counters_.withheld);
  if (!result_.estimates)
    for (int i = 0; i < sensors_; ++i) result_.reason[static_cast<std::size_t>(i)] |= reason::withheld;
  result_.flags = estimate_flags();
}

std::uint32_t MonitorCycle::estimate_flags() const noexcept {
  namespace flag = idl::estimate_flag;
  std::uint32_t flags = 0;
  if (!error_.settled()) flags |= flag::converging;
  estimation::SensorMask served = result_.fused;
  for (int i = 0; i < sensors_; ++i)
    if (result_.reason[static_cast<std::size_t>(i)] == reason::repeated) served.set(static_cast<std::size_t>(i));
  if ((served & filter_.sensors()) != filter_.sensors() || condition_check_.replaced() > 0) flags |= flag::bridging;
  if (!filter_.sensor_set().is_full()) flags |= flag::degraded;
  if (!valid_) flags |= flag::off_design;
  if (shift_.raised()) flags |= flag::shifted;
  if (fleet_.implausible()) flags |= flag::implausible;
  return flags;
}

bool MonitorCycle::no_input(double age_s) noexcept {
  const double limit_s = options_.stale_periods * design_->model.sample_time_s;
  if (age_s <= limit_s) return false;
  input_lost_.set(true, {idl::EventKind::input_lost, 0, true, age_s, limit_s, sequence_stands() ? 0 : dropped_},
                  events_);
  // The source is gone: whoever sends next, and may be followed, takes its place.
  sample_check_.release_source();
  if (!sample_check_.only_one()) second_source_.end(events_);
  return true;
}

}  // namespace ehm::monitor
