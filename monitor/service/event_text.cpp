// SPDX-License-Identifier: Apache-2.0
#include "monitor/service/event_text.h"

#include <spdlog/fmt/fmt.h>

#include <array>

#include "deploy/runtime/numbers/index.h"
#include "idl/wire_names.h"
#include "monitor/checks/condition_check.h"
#include "monitor/checks/sample_check.h"
#include "monitor/checks/sample_time_watch.h"
#include "monitor/cycle/cycle_state.h"
#include "monitor/shared/budget_watch.h"

namespace ehm::monitor {

namespace {

const linear_model::Channel* channel_of(const Event& e, const linear_model::LinearModel& model) {
  switch (e.kind) {
    case idl::EventKind::sensor_fault:
    case idl::EventKind::ambiguous_fault:
    case idl::EventKind::slow_bias:
    case idl::EventKind::slow_sensor:
      return &model.sensors.at(e.channel);
    case idl::EventKind::health_shift:
    case idl::EventKind::health_limit:
    case idl::EventKind::implausible:
      return &model.health.at(e.channel);
    case idl::EventKind::auxiliary_limit:
      return &model.auxiliary.at(e.channel);
    default:
      return nullptr;
  }
}

std::string reasons(std::uint32_t detail) {
  namespace reason = idl::reject_reason;
  constexpr std::pair<std::uint32_t, const char*> names[]{{reason::source_invalid, "marked invalid by its source"},
                                                          {reason::not_finite, "not finite"},
                                                          {reason::range, "out of range"},
                                                          {reason::rate, "impossible rate"},
                                                          {reason::stuck, "stuck"},
                                                          {reason::innovation_gate, "outside the innovation gate"},
                                                          {reason::excluded, "declared faulty earlier"}};
  std::string text;
  for (const auto& [bit, name] : names)
    if (detail & bit) text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

/// What the fault detector measured, or what the checks saw.
std::string sensor_fault(const Event& e, const linear_model::LinearModel& model) {
  namespace reason = idl::reject_reason;
  const auto& sensor = model.sensors.at(e.channel);
  if (e.detail & reason::quiet)
    return fmt::format(
        "stuck: its noise is missing, it moves by {:.3g} {} where a healthy one moves by {:.3g} at least; "
        "stuck_samples = 0 in its [[sensor]] table turns this off",
        e.value, sensor.unit, e.threshold);
  if (e.detail & reason::stuck)
    return fmt::format(
        "stuck: {:.0f} equal values in a row, a healthy one shows fewer than {:.0f}; stuck_samples in its "
        "[[sensor]] table sets the limit",
        e.value, e.threshold);
  if (e.detail & reason::noise) return fmt::format("its noise grew {:.1f} times or more", e.value);
  if (!(e.detail & reason::bias)) return reasons(e.detail);
  const double sigma = model.sensor_noise_sigma(as_index(e.channel));
  return fmt::format("bias {:+.4g} {}, {:+.1f} sigma, since {:.2f} s", e.value, sensor.unit, e.value / sigma, e.age_s);
}

/// Name and unit of a word of the flight condition or of an actuator.
std::pair<std::string, std::string> word_of(const Event& e, const linear_model::LinearModel& model) {
  constexpr std::array<std::pair<const char*, const char*>, flight_words> flight{
      {{"altitude_m", "m"}, {"mach", ""}, {"delta_isa_k", "K"}}};
  if (e.channel < flight_words) return flight[e.channel];
  const auto& actuator = model.controls.at(e.channel - flight_words);
  return {actuator.name, actuator.unit};
}

std::string condition_fault(const Event& e, const linear_model::LinearModel& model) {
  const auto [name, unit] = word_of(e, model);
  if (!e.raised) return fmt::format("{} is good again", name);
  const std::string value = fmt::format("{:.6g}{}{}", e.value, unit.empty() ? "" : " ", unit);
  if (e.detail == 0)
    return fmt::format("{} jumped from {:.6g} to {} between two samples and stays there: it is believed", name,
                       e.threshold, value);
  return fmt::format("{} is lost: it is {}, for longer than checks.bridge_samples allows: estimates are withheld", name,
                     value);
}

/// What became of a readable checkpoint at the engine's first sample; of an unreadable one the file's reader tells.
std::string checkpoint_text(const Event& e) {
  switch (static_cast<Resumption>(e.detail)) {
    case Resumption::taken:
      return fmt::format("the filter resumed from its checkpoint of {:.3g} s before this sample", e.value);
    case Resumption::companions_cold:
      return fmt::format(
          "the filter resumed from its checkpoint of {:.3g} s before this sample; estimators beside it that the "
          "checkpoint does not hold start cold",
          e.value);
    case Resumption::wrong_shape:
      return "the checkpoint does not fit the design's shape: the filter starts cold";
    case Resumption::other_source:
      return "the checkpoint is of another source than this sample: the filter starts cold";
    case Resumption::not_later:
      return fmt::format("the source started anew after the checkpoint ({:.3g} s by its clock): the filter starts cold",
                         e.value);
    case Resumption::too_old:
      return fmt::format(
          "the checkpoint is {:.4g} s older than this sample, allowed is {:.4g} s: the filter starts cold", e.value,
          e.threshold);
  }
  return "the checkpoint was refused";
}

/// What came since the last sample in order, where anything did.
std::string input_lost(const Event& e) {
  constexpr std::pair<SampleVerdict, const char*> names[]{{SampleVerdict::duplicate, "duplicates of the last one"},
                                                          {SampleVerdict::reordered, "older ones"},
                                                          {SampleVerdict::malformed, "malformed ones"},
                                                          {SampleVerdict::foreign, "those of another source"}};
  std::string came;
  for (const auto& [verdict, name] : names)
    if (e.detail >> static_cast<unsigned>(verdict) & 1u) came += (came.empty() ? "" : ", ") + std::string(name);
  if (came.empty()) return fmt::format("no sample for {:.3f} s, estimates are stale", e.value);
  return fmt::format("no usable sample for {:.3f} s, estimates are stale; what came: {}", e.value, came);
}

/// All sensors that stand apart, by the bits of the detail.
std::string unlikely_engine(const Event& e, const linear_model::LinearModel& model) {
  if (!e.raised) return "the sensors together stand where an engine of the fleet does again";
  std::string names;
  for (std::size_t i = 0; i < model.sensors.size(); ++i)
    if (e.detail >> i & 1u) names += ' ' + model.sensors[i].name;
  return fmt::format(
      "the sensors together stand where no engine of the fleet does, at {:.1f} of its spread where {:.1f} is trusted; "
      "beside the others these stand apart:{}",
      e.value, e.threshold, names.empty() ? " none by itself" : names);
}

std::string estimator_name(const Event& e) {
  return e.channel < idl::estimator_names.size() ? idl::estimator_names[e.channel] : "?";
}

/// A replay knows that it was so, and not how long it took.
std::string estimator_overrun(const Event& e) {
  if (!e.raised) return fmt::format("estimator {} flies again, from a cold start", estimator_name(e));
  if (e.threshold == 0.0)
    return fmt::format("estimator {} overran its budget where this was recorded: it rests for 10 s", estimator_name(e));
  return fmt::format(
      "estimator {} took {:.0f} us for a sample, and {} times in a row more than the {:.0f} us of estimator.budget_ms: "
      "it rests for 10 s",
      estimator_name(e), e.value, BudgetWatch::most_overruns, e.threshold);
}

std::string restart_reason(const Event& e) {
  switch (static_cast<RestartReason>(e.detail)) {
    case RestartReason::command:
      return "reset by an operator";
    case RestartReason::other_design:
      return "with another design or other options";
    case RestartReason::described_anew:
      return "its source describes its channels otherwise than before";
    case RestartReason::source_restarted:
      return e.value == 0.0
                 ? "the source restarted, its numbers begin anew"
                 : fmt::format("the source restarted, its numbers begin anew ({:+.3f} s by its clock)", e.value);
    case RestartReason::time_back:
      return fmt::format("the source's time jumped back by {:.3f} s", -e.value);
    case RestartReason::time_ahead:
      return fmt::format("the source paused, or its time jumped ahead, by {:.3f} s; no sample is missing", e.value);
    case RestartReason::gap:
      return fmt::format("a gap of {:.3f} s in the source's samples, {:.4g} s are bridged", e.value, e.threshold);
    case RestartReason::sequence_jump:
      return fmt::format("the sequence jumped by {:.4g} s of samples, which the source's time does not explain",
                         e.value);
  }
  return "for a reason that this version does not know";
}

std::string stamp_trouble(const Event& e) {
  const char* goes_on = "steps come from the sequence, estimates go on";
  switch (static_cast<StampState>(e.detail)) {
    case StampState::unset:
      return fmt::format("source_time_ns is not set (0): {}, the sample time cannot be checked", goes_on);
    case StampState::repeated:
      return fmt::format("source_time_ns repeats: the source's clock is coarse or stands still; {}", goes_on);
    case StampState::set_back:
      return fmt::format("source_time_ns stepped back by {:.3g} s: the source's clock was set or jitters; {}", -e.value,
                         goes_on);
    case StampState::good:
      break;
  }
  return "source_time_ns does not measure time";
}

}  // namespace

std::string channel_name(const Event& event, const linear_model::LinearModel& model) {
  if (event.kind == idl::EventKind::estimator_overrun || event.kind == idl::EventKind::estimator_chosen)
    return estimator_name(event);
  if (event.kind == idl::EventKind::condition_fault) return word_of(event, model).first;
  const auto* channel = channel_of(event, model);
  return channel ? channel->name : std::string();
}

std::string event_text(const Event& e, const linear_model::LinearModel& model) {
  const auto* c = channel_of(e, model);
  if (!e.raised && e.detail == Event::design_exchanged) return "ended: another design, or other options, fly";
  if (!e.raised && e.detail == Event::reassessed) return "ended: the filter started anew, and judges anew";
  switch (e.kind) {
    case idl::EventKind::sensor_fault:
      return e.raised ? fmt::format("sensor {} is faulty ({}) and no longer used", c->name, sensor_fault(e, model))
                      : fmt::format("sensor {} is good again and used", c->name);
    case idl::EventKind::health_shift:
      return e.raised ? fmt::format("{} changed by {:+.4f} {} (noticeable from {:.4f})", c->name, e.value, c->unit,
                                    e.threshold)
                      : fmt::format("{} has settled after its change", c->name);
    case idl::EventKind::health_limit:
    case idl::EventKind::auxiliary_limit:
      return e.raised ? fmt::format("{} is {:.5g} {}, beyond its limit {:.5g}", c->name, e.value, c->unit, e.threshold)
                      : fmt::format("{} is back inside its limit", c->name);
    case idl::EventKind::input_lost:
      return e.raised ? input_lost(e) : "samples arrive again";
    case idl::EventKind::filter_restart:
      return "the filter started anew: " + restart_reason(e);
    case idl::EventKind::operating_point:
      return e.raised ? fmt::format(
                            "the engine flies {:.2f} times farther from the design's point than it is valid: estimates "
                            "are withheld",
                            e.value)
                      : "the engine is back at the design's point, the filter starts anew";
    case idl::EventKind::no_design:
      return e.raised
                 ? fmt::format("{:.0f} sensors are faulty and no design flies without them: estimates are withheld",
                               e.value)
                 : "enough sensors are good again";
    case idl::EventKind::sample_time:
      return e.raised
                 ? fmt::format("samples come every {:.4g} s, the design is made for {:.4g} s: estimates are withheld",
                               e.value, e.threshold)
             : e.detail == SampleTimeWatch::not_measured
                 ? "the source's stamps measure no sample time any more: estimates go on unchecked, the filter starts "
                   "anew"
                 : "samples come in the design's time again, the filter starts anew";
    case idl::EventKind::second_source:
      if (!e.raised)
        return "one source only sends samples of this engine again, or none does and another may take over";
      if (e.value == e.threshold)
        return fmt::format(
            "another writer also sends samples of this engine as source {:.0f}; the first is listened to", e.value);
      return fmt::format("source {:.0f} also sends samples of this engine; source {:.0f} is listened to", e.value,
                         e.threshold);
    case idl::EventKind::recording:
      return e.raised ? fmt::format("the recording is incomplete: {:.0f} rows are lost so far", e.value)
                      : "the recording loses no rows any more";
    case idl::EventKind::ambiguous_fault:
      return e.raised ? fmt::format("something changed abruptly, and sensor or component cannot be told (likeliest {})",
                                    c->name)
                      : "the abrupt change is settled";
    case idl::EventKind::slow_bias:
      if (e.raised)
        return fmt::format(
            "sensor {} reads {:+.4g} {} off, which wear does not explain: a drift, or a bias from the start", c->name,
            e.value, c->unit);
      if (e.detail & idl::reject_reason::bias)
        return fmt::format("sensor {} has come back from a drift, by {:+.4g} {}; the estimates follow", c->name,
                           e.value, c->unit);
      return fmt::format("sensor {} stands where wear explains it again", c->name);
    case idl::EventKind::condition_fault:
      return condition_fault(e, model);
    case idl::EventKind::slow_sensor:
      if (!e.raised) return fmt::format("sensor {} is updated with each sample again", c->name);
      return fmt::format(
          "sensor {} is updated every {:.3g} s, the design has {:.3g} s: each value is used once, and its "
          "share of the estimates is slower; state its update_period_s and design anew",
          c->name, e.value, e.threshold);
    case idl::EventKind::checkpoint:
      return checkpoint_text(e);
    case idl::EventKind::source_stamps:
      return e.raised ? stamp_trouble(e) : "the source's stamps measure time again";
    case idl::EventKind::source_sequence:
      return e.raised ? fmt::format(
                            "sequence stands still: new samples carry the number {:.0f} of the one before; they "
                            "are dropped as duplicates. Add 1 a sample",
                            e.value)
                      : "the sequence grows with each sample again";
    case idl::EventKind::implausible:
      return e.raised ? fmt::format("{} is estimated {:.1f} sigmas of the fleet from nominal, trusted are {:.1f}",
                                    c->name, e.value, e.threshold)
                      : fmt::format("{} is where the fleet's engines are again", c->name);
    case idl::EventKind::unlikely_engine:
      return unlikely_engine(e, model);
    case idl::EventKind::engine_left:
      return e.raised ? fmt::format("silent for {:.0f} s: its filter is free for another engine", e.value)
                      : "the engine is back, and starts cold";
    case idl::EventKind::command_flood:
      return e.raised ? fmt::format("resets come faster than one in {:.3g} s: {:.0f} are refused", e.threshold, e.value)
                      : "resets are obeyed again";
    case idl::EventKind::estimator_fallback:
      if (e.raised)
        return fmt::format(
            "the published estimator has had no answer for {:.0f} samples: the tuner filter's estimates are published "
            "in its place",
            e.value);
      return e.value > 0.0
                 ? fmt::format("the published estimator has answered {:.0f} samples, and is published again", e.value)
                 : "the published estimator is published again";
    case idl::EventKind::estimator_overrun:
      return estimator_overrun(e);
    case idl::EventKind::estimator_chosen:
      return fmt::format("estimates of {} are published, by order", estimator_name(e));
    case idl::EventKind::second_monitor:
    case idl::EventKind::input_deadline:
    case idl::EventKind::input_liveliness:
    case idl::EventKind::configuration:
    case idl::EventKind::incompatible_qos:
    case idl::EventKind::security:
    case idl::EventKind::unreadable_peer:
    case idl::EventKind::held_up:
    case idl::EventKind::source_channels:
    case idl::EventKind::flight_history:
      break;  // their messages are made where they happen, off the cycle
  }
  return "unknown event";
}

}  // namespace ehm::monitor
