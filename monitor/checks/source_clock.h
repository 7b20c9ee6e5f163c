// SPDX-License-Identifier: Apache-2.0
#pragma once
// How much time has passed by a source's stamps. They only measure; order comes from the sequence number.
//
// A stamp tells something if it is set (0 is not) and differs from the last one that told something: dt is the time
// between the two. A stamp that repeats (a coarse clock, or one that stands still) and one that is not set tell
// nothing; `stood` counts the sample times that passed in the meantime. The stamps have the time for n sample times if
//
//   |dt - Ts (n + stood)| <= 0.05 s + 1 % of Ts |n + stood|
//
// A tick of 20 ms, 8 ms of jitter at both ends and a step of NTP's of 20 ms at once are less than 0.05 s.
//
// Real-time safe: yes.

#include <cmath>
#include <cstdint>
#include <limits>

namespace ehm::monitor {

enum class StampState : std::uint32_t { good = 0, unset = 1, repeated = 2, set_back = 3 };

/// From the last sample in order to another one.
struct Elapsed {
  StampState state = StampState::good;
  bool told = false;   ///< dt_s is known
  double dt_s = 0.0;   ///< since the last stamp that told something; 0 where not known
  double stood = 0.0;  ///< sample times between that stamp and the last sample

  /// Do the stamps have the time for `steps` sample times, negative for a sample from before the last one?
  bool fits(double steps, double sample_time_s) const noexcept {
    const double expected_s = sample_time_s * (steps + stood);
    return told && std::abs(dt_s - expected_s) <= 0.05 + 0.01 * std::abs(expected_s);
  }
  /// The same within a fifth of a sample time.
  bool fits_closely(double steps, double sample_time_s) const noexcept {
    return told && std::abs(dt_s - sample_time_s * (steps + stood)) <= 0.2 * sample_time_s;
  }
};

class SourceClock {
 public:
  void start(std::int64_t time_ns) noexcept {
    last_ns_ = time_ns;
    stood_ = 0.0;
  }
  Elapsed elapsed(std::int64_t time_ns) const noexcept {
    if (time_ns == 0) return {StampState::unset, false, 0.0, stood_};
    if (last_ns_ == 0) return {StampState::good, false, 0.0, stood_};  // the first one that is set
    if (time_ns == last_ns_) return {StampState::repeated, false, 0.0, stood_};
    const double dt_s = seconds_between(last_ns_, time_ns);
    return {dt_s < 0.0 ? StampState::set_back : StampState::good, true, dt_s, stood_};
  }
  /// Takes the stamp of a sample in order, `steps` sample times after the last one.
  void advance(std::int64_t time_ns, std::uint64_t steps) noexcept {
    if (time_ns == 0 || time_ns == last_ns_)
      stood_ += static_cast<double>(steps);
    else
      start(time_ns);
  }
  /// The last stamp that told something; 0 if none was ever set.
  std::int64_t last_ns() const noexcept { return last_ns_; }

 private:
  /// Stamps may be anything: at the ends of their range the difference saturates.
  static double seconds_between(std::int64_t from_ns, std::int64_t to_ns) noexcept {
    std::int64_t difference_ns = 0;
    if (__builtin_sub_overflow(to_ns, from_ns, &difference_ns))
      difference_ns =
          to_ns > from_ns ? std::numeric_limits<std::int64_t>::max() : std::numeric_limits<std::int64_t>::min();
    return 1e-9 * static_cast<double>(difference_ns);
  }

  std::int64_t last_ns_ = 0;
  double stood_ = 0.0;
};

}  // namespace ehm::monitor
