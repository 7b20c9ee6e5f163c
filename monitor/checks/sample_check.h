#pragma once
// Is this sample usable at all, and where does it belong in time? Order comes from the sequence number, dt from the
// source's own clock; the source's clock is never compared with ours.
//
//   accepted       next in order, `steps` sample times after the last one (1: none lost)
//   first          the filter starts here
//   restarted      the source started anew, time stepped back, or jumped ahead by more than restart_gap_s, or the
//                  sequence by more than its time explains: the filter restarts here
//   duplicate, reordered (overtaken on the way), malformed: dropped and counted
//   foreign        from another source, or another writer with the same source_id, than the one that this engine
//                  follows: dropped and counted. The source is the one of checks.source_id, or the first that spoke;
//                  another writer, and without that option another source, may take over once it has been silent
//                  (release_source).
//
// Real-time safe: yes.

#include <cstdint>

#include "monitor/options.h"
#include "monitor/sample.h"

namespace ehm::monitor {

enum class SampleVerdict { first, accepted, restarted, duplicate, reordered, malformed, foreign };

struct SampleDecision {
  SampleVerdict verdict = SampleVerdict::malformed;
  int steps = 1;           ///< filter predictions to make; more than 1 after a loss
  std::uint64_t lost = 0;  ///< samples missing before this one
  double jump_s = 0.0;     ///< why restarted
  double dt_s = 0.0;       ///< source time since the last accepted sample; 0 after a start
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
  std::uint64_t last_sequence() const noexcept { return last_sequence_; }
  std::int64_t last_time_ns() const noexcept { return last_time_ns_; }

 private:
  bool malformed(const Sample& sample) const noexcept;
  bool foreign(const Sample& sample) const noexcept;
  SampleDecision restart(const Sample& sample, double jump_s) noexcept;

  CheckOptions options_;
  int sensors_, actuators_;
  double sample_time_s_;
  bool started_ = false, bound_ = false;
  std::uint32_t source_id_ = 0;
  std::uint64_t writer_ = 0;
  std::uint64_t last_sequence_ = 0;
  std::int64_t last_time_ns_ = 0;
};

}  // namespace ehm::monitor
