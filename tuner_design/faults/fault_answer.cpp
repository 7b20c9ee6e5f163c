// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/faults/fault_answer.h"

#include <algorithm>
#include <cmath>

#include "idl/wire_values.h"

namespace ehm::tuner_design {
namespace {

Answer answer_of(idl::EventKind kind) {
  switch (kind) {
    case idl::EventKind::sensor_fault:
      return Answer::sensor;
    case idl::EventKind::health_shift:
      return Answer::component;
    case idl::EventKind::ambiguous_fault:
      return Answer::ambiguous;
    case idl::EventKind::slow_bias:
      return Answer::slow_bias;
    default:
      return Answer::nothing;
  }
}

}  // namespace

const char* name_of(Answer answer) {
  switch (answer) {
    case Answer::sensor:
      return "sensor";
    case Answer::component:
      return "component";
    case Answer::ambiguous:
      return "ambiguous";
    case Answer::slow_bias:
      return "slow_bias";
    case Answer::nothing:
      break;
  }
  return "nothing";
}

bool is_answer(const monitor::Event& event) {
  return event.raised && answer_of(event.kind) != Answer::nothing;
}

void note_answer(const monitor::Event& event, double since_onset_s, bool broken, FaultOutcome& outcome) {
  if (!is_answer(event)) return;
  const Answer answer = answer_of(event.kind);
  if (since_onset_s < 0.0 || !broken) {
    ++outcome.false_alarms;
    if (broken) return;
  }
  if (!outcome.delay_s) outcome.delay_s = since_onset_s;
  // A drift may look like a component at first; the slow answer is the later and better one.
  if (answer == Answer::slow_bias) outcome.answer = Answer::nothing;
  const bool named = outcome.answer != Answer::nothing && outcome.answer != Answer::ambiguous;
  if (named || (answer == Answer::ambiguous && outcome.answer != Answer::nothing)) return;
  outcome.answer = answer;
  outcome.channel = event.channel;
  outcome.named_s = since_onset_s;
  outcome.size = event.value;
}

bool is_right(const FaultCase& what, const FaultOutcome& outcome) {
  switch (what.row->broken) {
    case Broken::nothing:
      return outcome.answer == Answer::nothing;
    case Broken::component:
      return outcome.answer == Answer::component;
    default:
      return (outcome.answer == Answer::sensor || outcome.answer == Answer::slow_bias) &&
             outcome.channel == what.channel;
  }
}

void to_sample(const engine_sim::EngineSample& from, double time_s, monitor::Sample& to) {
  to.schema = idl::schema_version;
  to.source_id = 1;
  to.sequence = from.sequence;
  to.source_time_ns = std::llround(1e9 * time_s);
  to.flight = {from.flight.altitude_m, from.flight.mach, from.flight.delta_isa_k};
  to.sensor_count = static_cast<std::uint32_t>(from.sensors.size());
  to.actuator_count = static_cast<std::uint32_t>(from.actuators.size());
  std::copy(from.actuators.begin(), from.actuators.end(), to.actuator.begin());
  to.sensor_valid = 0;
  for (std::size_t i = 0; i < from.sensors.size(); ++i) {
    to.sensor[i] = from.sensors[i].value;
    to.sensor_valid |= static_cast<std::uint32_t>(from.sensors[i].valid) << i;
  }
}

engine_sim::SensorFault sensor_fault(const FaultRow& row, double sigma, double onset_s, double sign) {
  engine_sim::SensorFault fault;
  fault.start_s = onset_s;
  switch (row.broken) {
    case Broken::bias:
      fault.kind = engine_sim::FaultKind::bias;
      fault.magnitude = row.size * sigma;
      break;
    case Broken::drift:
      fault.kind = engine_sim::FaultKind::drift;
      fault.magnitude = sign * row.size * sigma / 60.0;
      break;
    case Broken::noise:
      fault.kind = engine_sim::FaultKind::noise;
      fault.magnitude = row.size;
      break;
    case Broken::stuck:
      fault.kind = engine_sim::FaultKind::stuck;
      break;
    default:
      fault.kind = engine_sim::FaultKind::dropout;
  }
  return fault;
}

}  // namespace ehm::tuner_design
