// SPDX-License-Identifier: Apache-2.0
#pragma once
// The first station of the data path: is the sample in order, from the source that is followed, in time, and are the
// words that tell where the engine flies good? What is dropped is counted, and told by an event while it lasts.
// Real-time safe: yes, all but the constructor.

#include <cstdint>

#include "engine_sim/linear_model/linear_model.h"
#include "monitor/checks/condition_check.h"
#include "monitor/checks/sample_check.h"
#include "monitor/checks/sample_time_watch.h"
#include "monitor/checks/second_source_watch.h"
#include "monitor/checks/sequence_watch.h"
#include "monitor/checks/stamp_watch.h"
#include "monitor/cycle/cycle_result.h"
#include "monitor/data/events.h"
#include "monitor/data/options.h"
#include "monitor/data/sample.h"

namespace ehm::monitor {

class SampleIntake {
 public:
  SampleIntake(const CycleOptions& options, const linear_model::LinearModel& model);

  /// What the sample is. One that is not in order goes no further; a restart is to be made before take().
  SampleDecision decide(const Sample& sample, CycleCounters& counters, EventList& events) noexcept;
  /// Takes a sample that is in order.
  void take(const Sample& sample, const SampleDecision& decision, CycleCounters& counters, EventList& events) noexcept;
  /// The latest sample that was taken, bad words of flight and actuators replaced.
  const Sample& sample() const noexcept { return mended_; }
  /// Words of it that were replaced.
  std::uint64_t replaced() const noexcept { return condition_check_.replaced(); }
  /// It came at the design's sample time, and each of its words was good or there was something to replace it by.
  bool usable(const SampleDecision& decision, EventList& events) noexcept {
    return sample_time_.check(decision, events) && words_good_;
  }

  /// No sample for `age_s`, which is beyond `limit_s`: whoever sends next may be followed.
  void lost(double age_s, double limit_s, EventList& events) noexcept;
  /// Another source or time: flight and actuators are not compared with what came before.
  void forget_words(EventList& events) noexcept { condition_check_.reset(events); }
  /// The next sample is the first one.
  void reset(EventList& events) noexcept;
  /// Another design takes over: ends every condition that is raised.
  void retire(EventList& events) noexcept;

  bool malformed(const Sample& sample) const noexcept { return sample_check_.malformed(sample); }
  /// The source that is followed.
  std::uint32_t source_id() const noexcept { return sample_check_.source_id(); }
  bool foreign(std::uint32_t source_id, std::uint64_t writer) const noexcept {
    return sample_check_.foreign(source_id, writer);
  }
  std::uint64_t last_sequence() const noexcept { return sample_check_.last_sequence(); }
  std::int64_t last_time_ns() const noexcept { return sample_check_.last_time_ns(); }
  bool stale() const noexcept { return input_lost_.raised(); }
  bool sequence_stands() const noexcept { return sequence_watch_.standing(); }
  bool order_troubled() const noexcept { return sequence_watch_.raised() || stamp_watch_.raised(); }

 private:
  SampleCheck sample_check_;
  SampleTimeWatch sample_time_;
  StampWatch stamp_watch_;
  SequenceWatch sequence_watch_;
  SecondSourceWatch second_source_;
  ConditionCheck condition_check_;
  Condition input_lost_;
  std::uint32_t dropped_ = 0;  ///< verdicts on what came since the last sample in order; bit i: SampleVerdict i
  Sample mended_;
  bool words_good_ = true;
};

}  // namespace ehm::monitor
