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
    for (const Companion& companion : companions) all_.push_back({companion.name, companion.prototype->clone()});
  }
  CompanionEstimators(const CompanionEstimators& other) {
    for (const Flying& one : other.all_) all_.push_back({one.name, one.estimator->clone()});
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
  /// None flies in this sample, `steps` after the one before.
  void rest(int steps) noexcept {
    for (Flying& one : all_) {
      one.flies = false;
      one.unseen += steps;
    }
  }
  /// Those that did not fly in the last sample start anew; the others go on.
  void reset_idle() noexcept {
    for (Flying& one : all_) {
      if (one.flies) continue;
      one.estimator->reset();
      one.unseen = 0;
    }
  }
  /// Allocates nothing if there are as many `states` already.
  void save(std::vector<CompanionState>& states) const noexcept;
  /// Each goes on from its own among `states`, and its next prediction leads over `unseen` samples that it missed;
  /// without one that fits it stays as it is: cold, in a new cycle. @returns whether every one goes on.
  bool restore(const std::vector<CompanionState>& states, int unseen) noexcept;

  /// The last restore() has found it a state of its own.
  bool went_on(std::size_t i) const noexcept { return all_[i].went_on; }

  /// Who flies this sample: all of them where the watch filter holds, else those that hold in these conditions.
  void choose(bool at_point, const estimation::Conditions& now, int steps) noexcept {
    for (Flying& one : all_) {
      one.flies = at_point || one.estimator->distance(now) <= 1.0;
      if (!one.flies) one.unseen += steps;
    }
  }
  void predict(estimation::SensorMask available, const estimation::Conditions& before, int steps) noexcept {
    for (Flying& one : all_) {
      if (!one.flies) continue;
      one.estimator->use(available);
      one.estimator->predict(before, steps + std::exchange(one.unseen, 0));
    }
  }
  void innovate(const estimation::SensorVector& y, const estimation::Conditions& now) noexcept {
    for (const Flying& one : all_)
      if (one.flies) one.estimator->innovate(y, now);
  }
  void update(estimation::SensorMask fused, std::int64_t hold) noexcept {
    for (const Flying& one : all_)
      if (one.flies) one.estimator->update(fused, hold);
  }
  double distance(std::size_t i, const estimation::Conditions& now) const noexcept {
    return all_[i].estimator->distance(now);
  }
  const estimation::Innovation& innovation(std::size_t i) const noexcept { return all_[i].estimator->innovation(); }
  estimation::Learned learned(std::size_t i) const noexcept { return all_[i].estimator->learned(); }
  bool begin_with(std::size_t i, const estimation::Learned& known, double wear_percent) noexcept {
    return all_[i].estimator->begin_with(known, wear_percent);
  }
  void next_flight(std::size_t i, double wear_percent) noexcept { all_[i].estimator->next_flight(wear_percent); }
  void widen(double excess) noexcept {
    for (const Flying& one : all_) one.estimator->widen(excess);
  }
  const estimation::Estimate& estimate(std::size_t i) const noexcept { return all_[i].estimator->estimate(); }

 private:
  struct Flying {
    std::string_view name;
    std::unique_ptr<estimation::Estimator> estimator;
    int unseen = 0;     ///< samples that the next prediction leads over
    bool flies = true;  ///< in the present sample
    bool went_on = false;
  };
  std::vector<Flying> all_;
};

}  // namespace ehm::monitor
