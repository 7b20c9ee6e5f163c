// SPDX-License-Identifier: Apache-2.0
#pragma once
// The estimators that fly beside the watch filter: the published one, where that is another, and the shadows. They get
// each sample with the sensors that the watch filter fuses, so that what is published changes nothing in what is found.
//
// A copy is a new start with the same kinds of estimators; assigning one to another of the same design and options
// allocates nothing. Real-time safe: yes, all but construction.

#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "monitor/cycle/cycle_state.h"
#include "monitor/estimation/estimator.h"

namespace ehm::monitor {

/// What one of them is made from.
struct Companion {
  std::string_view name;                                   ///< of the table of estimators (design/make_estimator.h)
  std::shared_ptr<const estimation::Estimator> prototype;  ///< has seen nothing yet
};

class CompanionEstimators {
 public:
  explicit CompanionEstimators(const std::vector<Companion>& companions) {
    for (const Companion& companion : companions) all_.push_back({companion.name, companion.prototype->clone(), 0});
  }
  CompanionEstimators(const CompanionEstimators& other) {
    for (const Flying& one : other.all_) all_.push_back({one.name, one.estimator->clone(), 0});
  }
  CompanionEstimators(CompanionEstimators&&) noexcept = default;
  CompanionEstimators& operator=(const CompanionEstimators&) noexcept {
    reset();
    return *this;
  }
  CompanionEstimators& operator=(CompanionEstimators&&) noexcept = default;
  ~CompanionEstimators() = default;

  void reset() noexcept {
    for (Flying& one : all_) {
      one.estimator->reset();
      one.unseen = 0;
    }
  }
  /// Allocates nothing if there are as many `states` already.
  void save(std::vector<CompanionState>& states) const noexcept;
  /// Each goes on from its own among `states`, and its next prediction leads over `unseen` samples that it missed; without
  /// one that fits it stays as it is: cold, in a new cycle. @returns whether every one goes on.
  bool restore(const std::vector<CompanionState>& states, int unseen) noexcept;

  void predict(estimation::SensorMask available, const estimation::Conditions& before, int steps) noexcept {
    for (Flying& one : all_) {
      one.estimator->use(available);
      one.estimator->predict(before, steps + std::exchange(one.unseen, 0));
    }
  }
  void update(const estimation::SensorVector& y, const estimation::Conditions& now, estimation::SensorMask fused,
              std::int64_t hold) noexcept {
    for (const Flying& one : all_) {
      one.estimator->innovate(y, now);
      one.estimator->update(fused, hold);
    }
  }
  void widen(double excess) noexcept {
    for (const Flying& one : all_) one.estimator->widen(excess);
  }
  const estimation::Estimate& estimate(std::size_t i) const noexcept { return all_[i].estimator->estimate(); }

 private:
  struct Flying {
    std::string_view name;
    std::unique_ptr<estimation::Estimator> estimator;
    int unseen = 0;  ///< samples that the next prediction leads over
  };
  std::vector<Flying> all_;
};

}  // namespace ehm::monitor
