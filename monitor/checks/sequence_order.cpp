// SPDX-License-Identifier: Apache-2.0
#include "monitor/checks/sequence_order.h"

#include <cmath>
#include <initializer_list>

namespace ehm::monitor {

namespace {

constexpr std::uint64_t turn_of(int bits) noexcept {
  return std::uint64_t{1} << bits;
}

}  // namespace

bool SequenceOrder::wraps(int bits, std::uint64_t sequence, const Elapsed& elapsed,
                          double sample_time_s) const noexcept {
  if (last_ >= turn_of(bits) || (bits_ != 0 && bits_ != bits)) return false;
  const std::uint64_t ahead = sequence + turn_of(bits) - last_;
  if (ahead == 1 && bits_ == bits) return true;
  if (!elapsed.told) return ahead <= near;
  const bool may_be_a_start = sequence <= 1 && ahead > near && bits_ != bits;
  const auto steps = static_cast<double>(ahead);
  return may_be_a_start ? elapsed.fits_closely(steps, sample_time_s) : elapsed.fits(steps, sample_time_s);
}

std::uint64_t SequenceOrder::whole_turns(std::uint64_t ahead, const Elapsed& elapsed,
                                         double sample_time_s) const noexcept {
  if (bits_ == 0 || !elapsed.told) return 0;
  const auto turn = static_cast<double>(turn_of(bits_));
  const double missing = elapsed.dt_s / sample_time_s - elapsed.stood - static_cast<double>(ahead);
  const double turns = std::round(missing / turn);
  if (turns < 1.0 || !elapsed.fits(static_cast<double>(ahead) + turns * turn, sample_time_s)) return 0;
  return static_cast<std::uint64_t>(turns * turn);
}

Place SequenceOrder::place(std::uint64_t sequence, const Elapsed& elapsed, double sample_time_s) const noexcept {
  if (sequence == last_) return {};
  if (sequence < last_) {
    for (const int bits : {8, 16, 32}) {
      if (!wraps(bits, sequence, elapsed, sample_time_s)) continue;
      const std::uint64_t ahead = sequence + turn_of(bits) - last_;
      return {ahead + whole_turns(ahead, elapsed, sample_time_s), 0, bits};
    }
    return {0, last_ - sequence};
  }
  const std::uint64_t ahead = sequence - last_;
  if (bits_ != 0 && sequence < turn_of(bits_)) {
    const std::uint64_t behind = last_ + turn_of(bits_) - sequence;
    const bool late = elapsed.told ? elapsed.fits(-static_cast<double>(behind), sample_time_s) : behind <= near;
    if (late && behind < ahead) return {0, behind};
  }
  return {ahead + whole_turns(ahead, elapsed, sample_time_s), 0};
}

void SequenceOrder::advance(std::uint64_t sequence, const Place& place) noexcept {
  last_ = sequence;
  if (place.wrapped_bits != 0) bits_ = place.wrapped_bits;
  if (bits_ != 0 && sequence >= turn_of(bits_)) bits_ = 0;
}

}  // namespace ehm::monitor
