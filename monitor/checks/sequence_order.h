// SPDX-License-Identifier: Apache-2.0
#pragma once
// Where a sequence number stands: so many samples ahead of the last one, or so many behind it.
//
// The number on the wire has 64 bits; a source's own counter may have 8, 16 or 32, and then goes on at 0 after 2^k - 1.
// A lower number than the last one, both below 2^k, is such a wrap if
//
//   the stamps have the time for the samples around the boundary (SourceClock), within a fifth of a sample time if the
//     number is 0 or 1, as a source that starts anew sends, after more than eight samples, or
//   the stamps tell nothing, and the boundary is at most eight samples away, or
//   it is 0 after 2^k - 1, and this counter has wrapped there before.
//
// Any other lower number is behind: overtaken on the way, or of a source that has started anew. A source that starts
// anew just when its stamps have the time for the rest of the range passes for a wrap; no time is missing then.
//
// Of a counter that has wrapped before, a higher number may belong to a sample from before the wrap that was overtaken
// (the stamps have the time, or it is at most eight behind), and a gap may hold whole turns of the counter: as many as
// the stamps have the time for.
//
// Real-time safe: yes.

#include <cstdint>

#include "monitor/checks/source_clock.h"

namespace ehm::monitor {

/// Both 0: the last number again.
struct Place {
  std::uint64_t ahead = 0;   ///< samples from the last one to this; 1: the next
  std::uint64_t behind = 0;  ///< samples from this to the last one
  int wrapped_bits = 0;      ///< the counter's width, if it wrapped in between
};

class SequenceOrder {
 public:
  /// Without stamps, and that near, a place is taken for granted.
  static constexpr std::uint64_t near = 8;

  void start(std::uint64_t sequence) noexcept {
    last_ = sequence;
    bits_ = 0;
  }
  Place place(std::uint64_t sequence, const Elapsed& elapsed, double sample_time_s) const noexcept;
  /// Takes the number of a sample in order, which stands there.
  void advance(std::uint64_t sequence, const Place& place) noexcept;
  std::uint64_t last() const noexcept { return last_; }

 private:
  bool wraps(int bits, std::uint64_t sequence, const Elapsed& elapsed, double sample_time_s) const noexcept;
  std::uint64_t whole_turns(std::uint64_t ahead, const Elapsed& elapsed, double sample_time_s) const noexcept;

  std::uint64_t last_ = 0;
  int bits_ = 0;  ///< of a counter that has wrapped; 0: not known
};

}  // namespace ehm::monitor
