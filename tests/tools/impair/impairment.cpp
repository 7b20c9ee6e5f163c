// SPDX-License-Identifier: Apache-2.0
#include "tests/tools/impair/impairment.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace ehm::test {

void Impairment::receive(const EngineSensors& arrived, double now_s) {
  ++counters_.received;
  // All draws first, so that one setting does not shift the fate by another.
  const double lost = uniform(), twice = uniform(), back = uniform();
  const double jitter = uniform(), second_jitter = uniform();
  EngineSensors sample = arrived;
  damage(sample);
  if (lost < settings.loss || now_s < cut_until_s_) {
    ++counters_.dropped;
    return;
  }
  const double ready_s = std::max(now_s, pause_until_s_) + 1e-3 * settings.delay_ms;
  const bool held_back = back < settings.reorder;
  counters_.held_back += held_back;
  enqueue(sample, ready_s + 1e-3 * (jitter * settings.jitter_ms + (held_back ? settings.reorder_ms : 0.0)));
  if (twice < settings.duplicate) {
    ++counters_.duplicated;
    enqueue(sample, ready_s + 1e-3 * second_jitter * settings.jitter_ms);
  }
}

void Impairment::damage(EngineSensors& sample) {
  const double not_a_number = uniform(), flip = uniform(), which_sensor = uniform(), which_bit = uniform();
  const std::size_t sensors = std::min<std::size_t>(sample.sensor_count(), sample.sensor().size());
  if (sensors > 0) {
    double& value = sample.sensor()[static_cast<std::size_t>(which_sensor * static_cast<double>(sensors))];
    if (not_a_number < settings.nan) {
      value = std::numeric_limits<double>::quiet_NaN();
      ++counters_.set_nan;
    }
    if (flip < settings.bit_flip) {
      value = std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) ^
                                    (std::uint64_t{1} << static_cast<unsigned>(64.0 * which_bit)));
      ++counters_.bits_flipped;
    }
  }
  if (settings.clock_offset_s != 0.0) {
    // Wraps round where a hostile stamp stands near the end.
    const auto offset_ns = static_cast<std::uint64_t>(static_cast<std::int64_t>(1e9 * settings.clock_offset_s));
    sample.source_time_ns(static_cast<std::int64_t>(static_cast<std::uint64_t>(sample.source_time_ns()) + offset_ns));
    ++counters_.restamped;
  }
}

void Impairment::enqueue(const EngineSensors& sample, double due_s) {
  if (settings.ordered != 0.0) due_s = std::max(due_s, last_due_s_);
  last_due_s_ = std::max(due_s, last_due_s_);
  waiting_.push({due_s, number_++, sample});
}

std::optional<EngineSensors> Impairment::send(double now_s) {
  if (waiting_.empty() || waiting_.top().due_s > now_s) return std::nullopt;
  const EngineSensors sample = waiting_.top().sample;
  waiting_.pop();
  ++counters_.sent;
  return sample;
}

std::optional<double> Impairment::next_due_s() const {
  if (waiting_.empty()) return std::nullopt;
  return waiting_.top().due_s;
}

}  // namespace ehm::test
