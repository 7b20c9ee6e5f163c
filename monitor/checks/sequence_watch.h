// SPDX-License-Identifier: Apache-2.0
#pragma once
// Does the source's sequence number grow? A duplicate that the network made is the same to the bit. A sample that
// carries the number of the one before with another stamp or other values is a new one whose number stood still: it is
// dropped as a duplicate all the same, since nobody can tell where in time it belongs, but said so at the second one,
// and ended after a second without. Real-time safe: yes.

#include <cmath>
#include <cstring>

#include "monitor/data/events.h"
#include "monitor/data/sample.h"

namespace ehm::monitor {

class SequenceWatch {
 public:
  explicit SequenceWatch(double sample_time_s) : calm_(std::lround(std::ceil(1.0 / sample_time_s))) {}

  /// A sample with the number of the one before.
  void repeated(const Sample& sample, EventList& events) noexcept {
    if (sample.source_time_ns == time_ns_ && std::memcmp(&sample.sensor, &sensor_, sizeof sensor_) == 0) return;
    remember(sample);
    ++in_a_row_;
    ++lately_;
    good_ = 0;
    if (lately_ >= enough)
      condition_.set(
          true,
          {.kind = idl::EventKind::source_sequence, .raised = true, .value = static_cast<double>(sample.sequence)},
          events);
  }
  void in_order(const Sample& sample, EventList& events) noexcept {
    remember(sample);
    in_a_row_ = 0;
    if (lately_ > 0 && ++good_ >= calm_) end(events);
  }
  /// Samples arrive, and their number does not grow.
  bool standing() const noexcept { return in_a_row_ >= enough; }
  /// It stands, or did so lately.
  bool raised() const noexcept { return condition_.raised(); }
  void end(EventList& events) noexcept {
    lately_ = 0;
    good_ = 0;
    condition_.set(false, {.kind = idl::EventKind::source_sequence}, events);
  }

 private:
  static constexpr int enough = 2;
  void remember(const Sample& sample) noexcept {
    time_ns_ = sample.source_time_ns;
    sensor_ = sample.sensor;
  }

  long calm_;  ///< samples in order
  std::int64_t time_ns_ = 0;
  decltype(Sample::sensor) sensor_{};
  long in_a_row_ = 0, lately_ = 0, good_ = 0;
  Condition condition_;
};

}  // namespace ehm::monitor
