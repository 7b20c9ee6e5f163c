// The part of the cycle that names faults and takes them out of the estimate: a named sensor's bias is subtracted from
// the filter's state, then the design without that sensor takes over. Real-time safe: yes, all of it.

#include <cmath>

#include "idl/wire_values.h"
#include "monitor/cycle/monitor_cycle.h"

namespace ehm::monitor {

namespace reason = idl::reject_reason;
using estimation::SensorSet;

namespace {
constexpr double ambiguity_lasts_s = 5.0;  // after the evidence has faded
constexpr double return_settles_in = 2.0;  // slowest time constants after a sensor has come back
}  // namespace

void MonitorCycle::detect() noexcept {
  estimation::SensorMask present;
  for (int i = 0; i < sensors_; ++i)
    present[static_cast<std::size_t>(i)] =
        (result_.reason[static_cast<std::size_t>(i)] & ~reason::innovation_gate) == 0;
  present &= filter_.sensors();
  declared_ = {};
  ungated_.step(filter_, present, result_.fused);
  if (have_design_ && !slow_start()) declare(faults_.step(ungated_.innovation(), present, steps_));
  settle_ambiguity(false);
}

void MonitorCycle::declare(const FaultVerdict& verdict) noexcept {
  const double age_s = design_->model.sample_time_s * (verdict.age + 1);
  const auto channel = static_cast<std::uint32_t>(verdict.channel);
  switch (verdict.kind) {
    case FaultKind::none:
      return;
    case FaultKind::sensor_bias:
    case FaultKind::sensor_noise:
      settle_ambiguity(true);
      return declare_sensor(verdict);
    case FaultKind::component_step:
      settle_ambiguity(true);
      return shift_.name({idl::EventKind::health_shift, channel, true, verdict.size, verdict.noticeable, 0, age_s},
                         events_);
    case FaultKind::ambiguous:
      ambiguous_channel_ = channel;
      unambiguous_samples_ = 0;
      ambiguous_.set(true, {idl::EventKind::ambiguous_fault, channel, true, verdict.size, verdict.noticeable, 0, age_s},
                     events_);
      return;
  }
}

void MonitorCycle::declare_sensor(const FaultVerdict& verdict) noexcept {
  const auto s = static_cast<std::size_t>(verdict.channel);
  const bool bias = verdict.kind == FaultKind::sensor_bias;
  const std::uint32_t why = bias ? reason::bias : reason::noise;
  declared_ = verdict;
  came_back_ = bias && filter_.sensor_set().is_full() && slow_bias_.ended_by(verdict.channel, verdict.size);
  if (came_back_)
    return events_.push({idl::EventKind::slow_bias, static_cast<std::uint32_t>(verdict.channel), false, verdict.size,
                         verdict.noticeable, why, design_->model.sample_time_s * (verdict.age + 1)});
  qualification_[s].exclude();
  sensor_fault_[s].set(true,
                       {idl::EventKind::sensor_fault, static_cast<std::uint32_t>(verdict.channel), true, verdict.size,
                        verdict.noticeable, why, bias ? design_->model.sample_time_s * (verdict.age + 1) : 0.0},
                       events_);
  result_.reason[s] |= why | reason::excluded;
}

void MonitorCycle::settle_ambiguity(bool decided) noexcept {
  if (!ambiguous_.raised()) return;
  unambiguous_samples_ = faults_.excited() ? 0 : unambiguous_samples_ + 1;
  const bool over =
      decided || static_cast<double>(unambiguous_samples_) * design_->model.sample_time_s > ambiguity_lasts_s;
  ambiguous_.set(!over, {idl::EventKind::ambiguous_fault, ambiguous_channel_, false, 0.0, 0.0, 0}, events_);
}

void MonitorCycle::take_out_fault() noexcept {
  if (declared_.kind != FaultKind::sensor_bias) return;
  // What the flying filter has of the bias: had the gate let all through, xi[age] times its size.
  const int sensor = declared_.channel;
  shift_by_ = -declared_.size / faults_.tables().noise_sigma(sensor) *
              faults_.signatures().state.col(declared_.age * sensors_ + sensor);
  ungated_.add_difference(shift_by_);
  filter_.shift(shift_by_);
}

/// The filter goes at once to where the good sensor would lead it.
void MonitorCycle::follow_return() noexcept {
  const int sensor = declared_.channel;
  const auto& signatures = faults_.signatures();
  shift_by_ = declared_.size / faults_.tables().noise_sigma(sensor) *
              (signatures.steady_state.col(sensor) - signatures.state.col(declared_.age * sensors_ + sensor));
  filter_.shift(shift_by_);
  listen_anew();
  shift_.reset();
}

/// With all sensors, once what was wrong with the shift has died away.
void MonitorCycle::listen_anew() noexcept {
  ungated_.reset();
  const double settle_s = return_settles_in * design_->full.slowest_time_constant_s;
  faults_.change_set(-1, std::llround(settle_s / design_->model.sample_time_s));
}

void MonitorCycle::exclude(int sensor) noexcept {
  take_out_fault();
  const double with_it = filter_.gain().C.row(sensor).dot(filter_.estimate());
  const double narrow = filter_.innovation_variance()(sensor);
  const bool knew_it = error_.settled();
  const estimation::HealthVector health = filter_.health();
  const estimation::AuxiliaryVector auxiliary = filter_.auxiliary();
  filter_.switch_sensor_set(SensorSet::without(sensor));
  error_.switch_to((*error_models_)[static_cast<std::size_t>(1 + sensor)], filter_.gain().from_full);
  const double without_it = filter_.gain().C.row(sensor).dot(filter_.estimate());
  const double bias = declared_.kind == FaultKind::sensor_bias ? declared_.size : 0.0;
  return_gate_.start(with_it - without_it, narrow, filter_.innovation_variance()(sensor), bias);
  gated_sensor_ = sensor;
  cold_return_ = false;
  // What the sensor has taught stays true, and the estimates go on without a step.
  if (knew_it)
    filter_.carry(health, auxiliary, design_->model.sample_time_s / ReturnGate::memory_s);
  else
    return_gate_.forget();
  ungated_.reset();
  faults_.change_set(sensor, 0);
}

void MonitorCycle::readmit() noexcept {
  const int sensor = filter_.sensor_set().missing();
  error_.switch_to(error_models_->front(), filter_.gain().to_full);
  filter_.switch_sensor_set(SensorSet::full());
  // The prediction without the sensor missed it by so much; the full filter would end where it does not.
  const double sigmas = return_gate_.innovation_mean() / faults_.tables().noise_sigma(sensor);
  shift_by_ = sigmas * faults_.tables().full.steady_state.col(sensor);
  filter_.shift(shift_by_);
  listen_anew();
}

}  // namespace ehm::monitor
