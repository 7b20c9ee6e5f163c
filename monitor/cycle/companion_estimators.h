// SPDX-License-Identifier: Apache-2.0
#pragma once
// The estimators that fly beside the watch filter: the published one, where that is another, and the shadows. They get
// each sample with the sensors that the watch filter fuses, so that what is published changes nothing in what is found.
//
// A copy is a new start with the same kinds of estimators; assigning one to another of the same design and options
// allocates nothing. Real-time safe: yes, all but construction.

#include <cstdint>
#include <memory>
#include <vector>

#include "monitor/estimation/estimator.h"

namespace ehm::monitor {

class CompanionEstimators {
 public:
  explicit CompanionEstimators(const std::vector<std::shared_ptr<const estimation::Estimator>>& prototypes) {
    for (const auto& prototype : prototypes) all_.push_back(prototype->clone());
  }
  CompanionEstimators(const CompanionEstimators& other) {
    for (const auto& one : other.all_) all_.push_back(one->clone());
  }
  CompanionEstimators(CompanionEstimators&&) noexcept = default;
  CompanionEstimators& operator=(const CompanionEstimators&) noexcept {
    reset();
    return *this;
  }
  CompanionEstimators& operator=(CompanionEstimators&&) noexcept = default;
  ~CompanionEstimators() = default;

  void reset() noexcept {
    for (const auto& one : all_) one->reset();
  }
  void predict(estimation::SensorMask available, const estimation::Conditions& before, int steps) noexcept {
    for (const auto& one : all_) {
      one->use(available);
      one->predict(before, steps);
    }
  }
  void update(const estimation::SensorVector& y, const estimation::Conditions& now, estimation::SensorMask fused,
              std::int64_t hold) noexcept {
    for (const auto& one : all_) {
      one->innovate(y, now);
      one->update(fused, hold);
    }
  }
  void widen(double excess) noexcept {
    for (const auto& one : all_) one->widen(excess);
  }
  const estimation::Estimate& estimate(std::size_t i) const noexcept { return all_[i]->estimate(); }

 private:
  std::vector<std::unique_ptr<estimation::Estimator>> all_;
};

}  // namespace ehm::monitor
