// SPDX-License-Identifier: Apache-2.0
#pragma once
// Is this sample usable at all, and where does it belong in time? Order and steps come from the sequence number
// (sequence_order.h); the source's stamps only measure, and are never compared with our clock (source_clock.h).
//
//   accepted       next in order, `steps` sample times after the last one (1: none lost), whatever its stamp says
//                  within restart_gap_s: repeated, not set, set back
//   first          the filter starts here
//   restarted      the filter restarts here, for a RestartReason
//   duplicate, reordered (overtaken on the way), malformed: dropped and counted
//   foreign        from another source, or another writer with the same source_id, than the one that this engine
//                  follows: dropped and counted. The source is the one of checks.source_id, or the first that spoke;
//                  another writer, and without that option another source, may take over once it has been silent
//                  (release_source).
//
// A number that falls, and is no wrap, is overtaken if the stamps have the time for that, or if they are earlier than
// the last sample's and it is no more than restart_gap_s behind. Otherwise the source has started anew. Where the
// stamps tell nothing it has, too, if the number is more than restart_gap_s behind, or is 0 or 1 and more than eight
// behind: sources count from 0 or 1.
//
// Real-time safe: yes.

#include <cstdint>

#include "monitor/checks/sequence_order.h"
#include "monitor/checks/source_clock.h"
#include "monitor/data/options.h"
#include "monitor/data/sample.h"

namespace ehm::monitor {

enum class SampleVerdict { first, accepted, restarted, duplicate, reordered, malformed, foreign };

/// Does a sample of that verdict go on to be estimated from?
constexpr bool in_order(SampleVerdict verdict) noexcept {
  return verdict == SampleVerdict::first || verdict == SampleVerdict::accepted || verdict == SampleVerdict::restarted;
}

/// Why the filter starts anew; with what `jump_s` is.
enum class RestartReason : std::uint32_t {
  command = 0,           ///< an operator's
  other_design = 1,      ///< or other options, by a reload
  source_restarted = 2,  ///< its numbers begin anew; seconds since its last sample by its clock, 0 where not known
  time_back = 3,         ///< the source's clock went back by more than restart_gap_s; seconds, negative
  time_ahead = 4,        ///< that clock, or a pause: more than restart_gap_s without a missing sample; seconds
  gap = 5,               ///< of more than restart_gap_s by its clock, or by the sequence where the stamps tell nothing
  sequence_jump = 6,     ///< further than time explains; seconds that so many samples would take
  described_anew = 7     ///< its source describes its channels otherwise than before
};

/// After which of them a sensor that was named faulty is another sensor, or measures another engine.
constexpr bool sensors_are_new(RestartReason reason) noexcept {
  return reason == RestartReason::other_design || reason == RestartReason::source_restarted ||
         reason == RestartReason::described_anew;
}

struct SampleDecision {
  SampleVerdict verdict = SampleVerdict::malformed;
  int steps = 1;           ///< filter predictions to make; more than 1 after a loss
  std::uint64_t lost = 0;  ///< samples missing before this one
  double jump_s = 0.0;     ///< why restarted
  double dt_s = 0.0;       ///< source time since the last stamp that told something; 0 where this one tells nothing
  StampState stamp = StampState::good;  ///< of an accepted sample
  RestartReason reason = RestartReason::command;
};

class SampleCheck {
 public:
  SampleCheck(const CheckOptions& options, int sensors, int actuators, double sample_time_s)
      : options_(options), sensors_(sensors), actuators_(actuators), sample_time_s_(sample_time_s) {}

  SampleDecision decide(const Sample& sample) noexcept;
  void reset() noexcept { started_ = false; }
  void release_source() noexcept {
    bound_ = false;
    writer_ = 0;
  }
  /// Who is followed: the only one that may be, or the latest that was.
  std::uint32_t source_id() const noexcept {
    return only_one() ? static_cast<std::uint32_t>(options_.source_id) : source_id_;
  }
  /// Whoever else may speak, nobody else is followed.
  bool only_one() const noexcept { return options_.source_id != 0; }
  /// Would a sample of this source and writer be dropped as foreign?
  bool foreign(std::uint32_t source_id, std::uint64_t writer) const noexcept;
  /// Not of the design's shape.
  bool malformed(const Sample& sample) const noexcept;
  std::uint64_t last_sequence() const noexcept { return order_.last(); }
  std::int64_t last_time_ns() const noexcept { return clock_.last_ns(); }

 private:
  SampleDecision start(const Sample& sample, RestartReason reason, double jump_s) noexcept;
  SampleDecision ahead(const Sample& sample, const Place& place, const Elapsed& elapsed) noexcept;
  bool overtaken(const Sample& sample, std::uint64_t behind, const Elapsed& elapsed) const noexcept;
  /// Sample times within restart_gap_s.
  std::uint64_t bound() const noexcept {
    return static_cast<std::uint64_t>(options_.restart_gap_s / sample_time_s_) + 1;
  }

  CheckOptions options_;
  int sensors_, actuators_;
  double sample_time_s_;
  bool started_ = false, bound_ = false;
  std::uint32_t source_id_ = 0;
  std::uint64_t writer_ = 0;
  SequenceOrder order_;
  SourceClock clock_;
};

}  // namespace ehm::monitor
