// SPDX-License-Identifier: Apache-2.0
#include "monitor/checks/sample_check.h"

#include <algorithm>
#include <cmath>

#include "idl/wire_values.h"

namespace ehm::monitor {

namespace {

// A gap in the sequence that would take so many times longer than what the source's clock shows is no loss: the source
// numbers anew.
constexpr double implausible = 10.0;

}  // namespace

bool SampleCheck::malformed(const Sample& s) const noexcept {
  if (s.schema != idl::schema_version) return true;
  if (s.sensor_count != static_cast<std::uint32_t>(sensors_)) return true;
  return s.actuator_count != static_cast<std::uint32_t>(actuators_);
}

bool SampleCheck::foreign(std::uint32_t source_id, std::uint64_t writer) const noexcept {
  if (only_one() && source_id != this->source_id()) return true;
  if (!bound_) return false;
  return source_id != source_id_ || (writer != writer_ && writer != 0 && writer_ != 0);
}

SampleDecision SampleCheck::start(const Sample& s, RestartReason reason, double jump_s) noexcept {
  const SampleVerdict verdict = started_ ? SampleVerdict::restarted : SampleVerdict::first;
  started_ = true;
  order_.start(s.sequence);
  clock_.start(s.source_time_ns);
  SampleDecision decision{verdict, 1, 0, jump_s};
  decision.reason = reason;
  return decision;
}

bool SampleCheck::overtaken(const Sample& s, std::uint64_t behind, const Elapsed& elapsed) const noexcept {
  if (elapsed.fits(-static_cast<double>(behind), sample_time_s_)) return true;
  if (elapsed.told) return elapsed.dt_s < 0.0 && behind <= bound();
  return behind <= SequenceOrder::near || (behind <= bound() && s.sequence > 1);
}

SampleDecision SampleCheck::ahead(const Sample& s, const Place& place, const Elapsed& elapsed) noexcept {
  const std::uint64_t lost = place.ahead - 1;
  const double by_sequence_s = sample_time_s_ * static_cast<double>(place.ahead);
  const double gap_s = elapsed.told ? elapsed.dt_s - sample_time_s_ * elapsed.stood : by_sequence_s;
  const bool explained = by_sequence_s <= implausible * (elapsed.told ? elapsed.dt_s : options_.restart_gap_s);
  if (gap_s > options_.restart_gap_s || (place.ahead > bound() && !explained)) {
    const RestartReason gap = lost == 0 ? RestartReason::time_ahead : RestartReason::gap;
    SampleDecision decision = explained ? start(s, gap, gap_s) : start(s, RestartReason::sequence_jump, by_sequence_s);
    if (explained) decision.lost = lost;
    return decision;
  }
  order_.advance(s.sequence, place);
  clock_.advance(s.source_time_ns, place.ahead);
  const auto steps = static_cast<int>(std::min(place.ahead, bound()));
  return {SampleVerdict::accepted, steps, lost, 0.0, elapsed.dt_s, elapsed.state};
}

SampleDecision SampleCheck::decide(const Sample& s) noexcept {
  if (malformed(s)) return {SampleVerdict::malformed};
  if (foreign(s.source_id, s.writer)) return {SampleVerdict::foreign};
  bound_ = true;
  source_id_ = s.source_id;
  if (s.writer != 0) writer_ = s.writer;
  if (!started_) return start(s, RestartReason::source_restarted, 0.0);

  const Elapsed elapsed = clock_.elapsed(s.source_time_ns);
  if (elapsed.dt_s < -options_.restart_gap_s) return start(s, RestartReason::time_back, elapsed.dt_s);
  const Place place = order_.place(s.sequence, elapsed, sample_time_s_);
  if (place.ahead > 0) return ahead(s, place, elapsed);
  if (place.behind == 0) return {SampleVerdict::duplicate};
  if (overtaken(s, place.behind, elapsed)) return {SampleVerdict::reordered};
  return start(s, RestartReason::source_restarted, elapsed.dt_s);
}

}  // namespace ehm::monitor
