// SPDX-License-Identifier: Apache-2.0
#pragma once
// What one source of one engine has sent so far: order, times, channels. Two clocks: the samples' own stamps, and ours
// at reception.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "engine_health.h"
#include "monitor/checks/sequence_order.h"
#include "monitor/listen/channel_record.h"

namespace ehm::monitor {

/// Times between samples that follow each other, seconds.
struct IntervalRecord {
  std::uint64_t count = 0;
  double min_s = 0.0, max_s = 0.0;

  void hear(double s) {
    min_s = count == 0 ? s : std::min(min_s, s);
    max_s = count == 0 ? s : std::max(max_s, s);
    ++count;
    const double off = s - mean_;
    mean_ += off / static_cast<double>(count);
    squares_ += off * (s - mean_);
  }
  double mean_s() const { return mean_; }
  /// Standard deviation.
  double jitter_s() const { return count > 1 ? std::sqrt(squares_ / static_cast<double>(count - 1)) : 0.0; }

 private:
  double mean_ = 0.0, squares_ = 0.0;
};

struct SourceRecord {
  /// What was sent while the endpoints matched arrives in a burst, which says nothing of the source's pace.
  static constexpr std::uint64_t settling_samples = 33;

  std::uint64_t samples = 0, in_order = 0, lost = 0, repeated = 0, overtaken = 0;
  std::uint64_t unset = 0, stood = 0, set_back = 0;  ///< stamps of samples in order that are 0, repeat, step back
  double longest_step_back_s = 0.0;
  IntervalRecord source, own;  ///< per sample: a gap of the sequence is divided by its length
  EngineSensors last;
  std::array<ChannelRecord, EHM_MAX_SENSORS> sensors;
  std::array<ChannelRecord, EHM_MAX_ACTUATORS> actuators;

  void hear(const EngineSensors& s, std::int64_t received_ns) {
    if (samples++ > 0) order(s, received_ns);
    for (std::size_t i = 0; i < sensors.size() && i < s.sensor_count(); ++i)
      sensors[i].hear(s.sensor()[i], (s.sensor_valid() >> i & 1u) != 0);
    for (std::size_t i = 0; i < actuators.size() && i < s.actuator_count(); ++i)
      actuators[i].hear(s.actuator()[i], true);
    last = s;
    received_ns_ = received_ns;
  }

 private:
  void order(const EngineSensors& s, std::int64_t received_ns) {
    if (samples == 2) {
      clock_.start(last.source_time_ns());
      order_.start(last.sequence_number());
      unset += last.source_time_ns() == 0;
    }
    const Elapsed elapsed = clock_.elapsed(s.source_time_ns());
    const Place place = order_.place(s.sequence_number(), elapsed, source.mean_s());
    if (place.ahead == 0) {
      ++(place.behind == 0 ? repeated : overtaken);
      // As when the source starts anew: what comes next is compared with this one.
      order_.start(s.sequence_number());
      clock_.start(s.source_time_ns());
      return;
    }
    ++in_order;
    lost += place.ahead - 1;
    check_stamp(elapsed);
    order_.advance(s.sequence_number(), place);
    clock_.advance(s.source_time_ns(), place.ahead);
    const double steps = static_cast<double>(place.ahead);
    if (last.source_time_ns() != 0 && s.source_time_ns() != 0)
      source.hear(1e-9 * (static_cast<double>(s.source_time_ns()) - static_cast<double>(last.source_time_ns())) /
                  steps);
    if (samples > settling_samples) own.hear(1e-9 * static_cast<double>(received_ns - received_ns_) / steps);
  }
  void check_stamp(const Elapsed& elapsed) {
    unset += elapsed.state == StampState::unset;
    stood += elapsed.state == StampState::repeated;
    set_back += elapsed.state == StampState::set_back;
    longest_step_back_s = std::max(longest_step_back_s, -elapsed.dt_s);
  }

  SourceClock clock_;
  SequenceOrder order_;
  std::int64_t received_ns_ = 0;
};

}  // namespace ehm::monitor
