#include "monitor/checks/sample_check.h"

#include <algorithm>
#include <limits>

#include "idl/wire_values.h"

namespace ehm::monitor {

namespace {

// A gap in the sequence that would take so many times longer than what the source's clock shows is no loss: the source
// numbers anew.
constexpr double implausible = 10.0;

/// Stamps may be anything: at the ends of their range the difference saturates.
double seconds_between(std::int64_t from_ns, std::int64_t to_ns) noexcept {
  std::int64_t difference_ns = 0;
  if (__builtin_sub_overflow(to_ns, from_ns, &difference_ns))
    difference_ns =
        to_ns > from_ns ? std::numeric_limits<std::int64_t>::max() : std::numeric_limits<std::int64_t>::min();
  return 1e-9 * static_cast<double>(difference_ns);
}

}  // namespace

bool SampleCheck::malformed(const Sample& s) const noexcept {
  if (s.schema != wire::schema_version) return true;
  if (s.sensor_count != static_cast<std::uint32_t>(sensors_)) return true;
  return s.actuator_count != static_cast<std::uint32_t>(actuators_);
}

bool SampleCheck::foreign(const Sample& s) const noexcept {
  if (only_one() && s.source_id != source_id()) return true;
  if (!bound_) return false;
  return s.source_id != source_id_ || (s.writer != writer_ && s.writer != 0 && writer_ != 0);
}

SampleDecision SampleCheck::restart(const Sample& s, double jump_s) noexcept {
  const SampleVerdict verdict = started_ ? SampleVerdict::restarted : SampleVerdict::first;
  started_ = true;
  last_sequence_ = s.sequence;
  last_time_ns_ = s.source_time_ns;
  return {verdict, 1, 0, jump_s};
}

SampleDecision SampleCheck::decide(const Sample& s) noexcept {
  if (malformed(s)) return {SampleVerdict::malformed};
  if (foreign(s)) return {SampleVerdict::foreign};
  bound_ = true;
  source_id_ = s.source_id;
  if (s.writer != 0) writer_ = s.writer;
  if (!started_) return restart(s, 0.0);

  const double dt_s = seconds_between(last_time_ns_, s.source_time_ns);
  if (dt_s < -options_.restart_gap_s) return restart(s, dt_s);  // time jumped backwards: a replay began
  if (s.sequence == last_sequence_) return {SampleVerdict::duplicate};
  if (s.sequence < last_sequence_) {
    // Later by its clock but lower in number: the source itself started anew. Otherwise it was overtaken on the way.
    return dt_s > 0.0 ? restart(s, dt_s) : SampleDecision{SampleVerdict::reordered};
  }
  if (dt_s <= 0.0) return restart(s, dt_s);  // the source's clock was set back
  if (dt_s > options_.restart_gap_s) {
    const std::uint64_t lost = s.sequence - last_sequence_ - 1;
    const bool explained = sample_time_s_ * static_cast<double>(lost) <= implausible * dt_s;
    SampleDecision decision = restart(s, dt_s);
    if (explained) decision.lost = lost;
    return decision;
  }
  const std::uint64_t ahead = s.sequence - last_sequence_;
  const auto bound = static_cast<std::uint64_t>(options_.restart_gap_s / sample_time_s_) + 1;
  if (ahead > bound && sample_time_s_ * static_cast<double>(ahead) > implausible * dt_s) return restart(s, dt_s);
  last_sequence_ = s.sequence;
  last_time_ns_ = s.source_time_ns;
  return {SampleVerdict::accepted, static_cast<int>(std::min(ahead, bound)), ahead - 1, 0.0, dt_s};
}

}  // namespace ehm::monitor
