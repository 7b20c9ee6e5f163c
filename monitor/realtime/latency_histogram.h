// SPDX-License-Identifier: Apache-2.0
#pragma once
// Latencies in fixed logarithmic buckets: 16 per octave from 1 us on, so a percentile is right within 4.5 %.
//
// Real-time safe: record yes. One thread records and reads.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace ehm::monitor {

class LatencyHistogram {
 public:
  void record(double latency_us) noexcept {
    ++counts_[bucket(latency_us)];
    ++total_;
    max_us_ = std::max(max_us_, latency_us);
  }
  /// Upper edge of the bucket that holds the given share of all values; 0 without values.
  double percentile_us(double share) const noexcept {
    if (total_ == 0) return 0.0;
    const auto wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(total_)));
    std::uint64_t seen = 0;
    for (std::size_t b = 0; b < buckets; ++b) {
      seen += counts_[b];
      if (seen >= wanted) return std::min(max_us_, std::exp2(static_cast<double>(b + 1) / per_octave));
    }
    return max_us_;
  }
  double max_us() const noexcept { return max_us_; }
  std::uint64_t total() const noexcept { return total_; }

 private:
  static constexpr std::size_t per_octave = 16, octaves = 24, buckets = per_octave * octaves;  // to 16 s
  static std::size_t bucket(double latency_us) noexcept {
    if (!(latency_us > 1.0)) return 0;
    return std::min(buckets - 1, static_cast<std::size_t>(std::log2(latency_us) * per_octave));
  }

  std::array<std::uint64_t, buckets> counts_{};
  std::uint64_t total_ = 0;
  double max_us_ = 0.0;
};

}  // namespace ehm::monitor
