// SPDX-License-Identifier: Apache-2.0
#pragma once
// Pairs truth and estimate by sequence number and keeps the worst |estimate - truth| / sigma_total of a block.
//
// Truth may come before or after its estimate; the last `depth` of each wait for the other.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "engine_health.h"

namespace ehm::soak {

/// One block's verdict on the estimates of one topic.
struct ErrorBlock {
  std::uint64_t values = 0;    ///< channel values compared
  std::uint64_t within_3 = 0;  ///< of them within three published sigmas
  double worst = 0.0;          ///< in sigmas
  std::size_t channel = 0;     ///< of the worst
};

class ErrorWatch {
 public:
  void hear(const EngineTruth& truth) { truth_[truth.sequence_number() % depth] = truth; }

  void hear(const EngineHealth& e) {
    if (const EngineTruth* t = truth_of(e.sequence_number(), e.source_time_ns()))
      for (std::size_t i = 0; i < e.health_count(); ++i)
        compare(health, i, e.health()[i] - t->health()[i], e.sigma_total()[i]);
  }
  void hear(const EngineAuxiliary& e) {
    if (const EngineTruth* t = truth_of(e.sequence_number(), e.source_time_ns()))
      for (std::size_t i = 0; i < e.auxiliary_count(); ++i)
        compare(auxiliary, i, e.auxiliary()[i] - t->auxiliary()[i], e.sigma_total()[i]);
  }

  ErrorBlock health, auxiliary;  ///< of the present block; whoever reads them sets them back

 private:
  static constexpr std::size_t depth = 4096;
  const EngineTruth* truth_of(std::uint64_t sequence, std::int64_t time_ns) const {
    const auto& t = truth_[sequence % depth];
    return t && t->sequence_number() == sequence && t->source_time_ns() == time_ns ? &*t : nullptr;
  }
  static void compare(ErrorBlock& block, std::size_t channel, double error, double sigma) {
    const double ratio = std::isfinite(error) && sigma > 0.0 ? std::abs(error) / sigma : 1e9;
    ++block.values;
    block.within_3 += ratio <= 3.0;
    if (ratio > block.worst) block.worst = ratio, block.channel = channel;
  }
  std::array<std::optional<EngineTruth>, depth> truth_;
};

}  // namespace ehm::soak
