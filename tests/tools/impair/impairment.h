// SPDX-License-Identifier: Apache-2.0
#pragma once
// A bad network between two domains: what happens to each sensor sample on its way, drawn from a seeded generator.
//
//   release time = arrival + delay + U(0, jitter) [+ reorder_ms for the share that is held back]
//   pause: what arrives is held until its end and then sent at once; cut: it is dropped
//
// The same seed and the same samples meet the same fate: every sample draws the same number of times whatever the
// settings. Knows no DDS and no clock: times are the caller's, in seconds from any origin.

#include <cstdint>
#include <optional>
#include <queue>
#include <random>
#include <vector>

#include "engine_health.h"

namespace ehm::test {

struct ImpairmentSettings {
  double loss = 0.0;       ///< share of samples that vanish
  double duplicate = 0.0;  ///< share sent twice, the second with a jitter of its own
  double reorder = 0.0;    ///< share held back by reorder_ms
  double reorder_ms = 40.0;
  double delay_ms = 0.0;
  double jitter_ms = 0.0;       ///< each sample by itself, so that they overtake each other beyond their spacing
  double ordered = 0.0;         ///< 1: nobody overtakes, as on a reliable connection
  double nan = 0.0;             ///< share in which one sensor reads NaN
  double bit_flip = 0.0;        ///< share in which one bit of one sensor's value is wrong
  double clock_offset_s = 0.0;  ///< added to the source time
};

struct ImpairmentCounters {
  std::uint64_t received = 0;  ///< received + duplicated = sent + dropped + pending
  std::uint64_t sent = 0;
  std::uint64_t dropped = 0;     ///< by loss or by a cut
  std::uint64_t duplicated = 0;  ///< copies made
  std::uint64_t held_back = 0, set_nan = 0, bits_flipped = 0, restamped = 0;
};

class Impairment {
 public:
  explicit Impairment(std::uint64_t seed) : random_(seed) {}

  ImpairmentSettings settings;

  /// A sample has come at `now_s`.
  void receive(const EngineSensors& sample, double now_s);
  /// The next sample to send by `now_s`, in the order of release; nothing if none is due.
  std::optional<EngineSensors> send(double now_s);
  /// When the next one is due; nothing without one.
  std::optional<double> next_due_s() const;
  void pause(double until_s) { pause_until_s_ = until_s; }
  void cut(double until_s) { cut_until_s_ = until_s; }

  const ImpairmentCounters& counters() const { return counters_; }
  std::size_t pending() const { return waiting_.size(); }

 private:
  struct Waiting {
    double due_s;
    std::uint64_t number;  ///< ties keep the order of arrival
    EngineSensors sample;
    bool operator>(const Waiting& other) const {
      return due_s > other.due_s || (due_s == other.due_s && number > other.number);
    }
  };

  double uniform() { return std::generate_canonical<double, 53>(random_); }
  void damage(EngineSensors& sample);
  void enqueue(const EngineSensors& sample, double due_s);

  std::mt19937_64 random_;
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> waiting_;
  std::uint64_t number_ = 0;
  double last_due_s_ = 0.0;
  double pause_until_s_ = -1.0, cut_until_s_ = -1.0;
  ImpairmentCounters counters_;
};

}  // namespace ehm::test
