// SPDX-License-Identifier: Apache-2.0
#pragma once
// How one estimator has done of late, beside the published one: its time, how well its innovations fit their own
// variances, and how far its health is from the published.
//
//   innovation_ratio = mean over fused sensors and samples of nu_i^2 / S_ii      1 as expected; far less with an
//                                                                               early gain (theory.md, section 18)
//   difference       = sqrt(mean_j ((h_j - h_published_j) / sigma_published_j)^2)   of the latest sample; no unit
//
// The mean is over all samples at first, then forgets in mean_samples. S_ii leaves out what the sensors share, so that
// the ratio is that of NIS to its expectation, but not chi-square distributed. Errors: none. Real-time safe: yes.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "deploy/runtime/numbers/index.h"
#include "monitor/estimation/estimator.h"

namespace ehm::monitor {

struct EstimatorTally {
  static constexpr double mean_samples = 1000.0;

  explicit EstimatorTally(std::string_view of) noexcept : name(of) {}

  std::string_view name;                      ///< of the table of estimators (design/make_estimator.h)
  std::uint64_t samples = 0;                  ///< in which it flew
  std::uint64_t answers = 0;                  ///< of those: its estimate holds
  std::int64_t spent_ns = 0, longest_ns = 0;  ///< its time, over all samples, and in one; 0 where none is measured
  double innovation_ratio = 0.0, difference = 0.0;

  void count(bool holds, std::int64_t ns) noexcept {
    ++samples;
    answers += holds;
    spent_ns += ns;
    if (ns > longest_ns) longest_ns = ns;
  }
  void look(const estimation::Innovation& innovation, estimation::SensorMask fused) noexcept {
    double sum = 0.0;
    int sensors = 0;
    for (int i = 0; i < innovation.value.size(); ++i) {
      if (!fused[as_size(i)] || !(innovation.variance(i) > 0.0)) continue;
      sum += innovation.value(i) * innovation.value(i) / innovation.variance(i);
      ++sensors;
    }
    if (sensors == 0 || !std::isfinite(sum)) return;
    looked_ = std::min(looked_ + 1.0, mean_samples);
    innovation_ratio += (sum / sensors - innovation_ratio) / looked_;
  }
  void compare(const estimation::Estimate& own, const estimation::Estimate& published) noexcept {
    double sum = 0.0;
    for (int j = 0; j < own.health.size(); ++j) {
      const double sigmas = (own.health(j) - published.health(j)) / published.health_sigma(j);
      sum += sigmas * sigmas;
    }
    difference = own.health.size() == 0 ? 0.0 : std::sqrt(sum / static_cast<double>(own.health.size()));
  }

 private:
  double looked_ = 0.0;
};

}  // namespace ehm::monitor
