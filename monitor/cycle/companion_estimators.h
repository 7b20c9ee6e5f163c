// SPDX-License-Identifier: Apache-2.0
#pragma once
// The estimators that fly beside the watch filter: the published one, where that is another, and the shadows. They get
// each sample with the sensors that the watch filter fuses, so that what is published changes nothing in what is found.
//
// One that takes too long may be told to rest: it gets no sample and has no estimate meanwhile, then it starts cold.
//
// A copy is a new start with the same kinds of estimators; assigning one to another of the same design and options
// allocates nothing. Real-time safe: yes, all but construction.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "monitor/cycle/cycle_state.h"
#include "monitor/cycle/estimator_tally.h"
#include "monitor/cycle/lap.h"
#include "monitor/estimation/estimator.h"

namespace ehm::monitor {

/// What one of them is made from.
struct Companion {
  std::string_view name;                                   ///< of the table of estimators (design/make_estimator.h)
  std::shared_ptr<const estimation::Estimator> prototype;  ///< has seen nothing yet
  estimation::SensorSpan span = {};                        ///< the prototype's
};

class CompanionEstimators {
 public:
  explicit CompanionEstimators(const std::vector<Companion>& companions) {
    for (const Companion& companion : companions) add(companion.name, *companion.prototype);
  }
  CompanionEstimators(const CompanionEstimators& other) : now_ns_(other.now_ns_) {
    for (const Flying& one : other.all_) add(one.tally.name, *one.estimator);
  }
  CompanionEstimators(CompanionEstimators&&) noexcept = default;
  CompanionEstimators& operator=(const CompanionEstimators&) noexcept {
    reset();
    for (Flying& one : all_) {
      one.tally = EstimatorTally(one.tally.name);
      one.rests = 0;
    }
    return *this;
  }
  CompanionEstimators& operator=(CompanionEstimators&&) noexcept = default;
  ~CompanionEstimators() = default;

  std::size_t size() const noexcept { return all_.size(); }
  /// The place of that one; -1: it is not among them.
  int find(std::string_view name) const noexcept;
  void measure(Stopwatch now_ns) noexcept { now_ns_ = now_ns; }
  Stopwatch stopwatch() const noexcept { return now_ns_; }

  void reset() noexcept {
    for (Flying& one : all_) {
      one.estimator->reset();
      one.unseen = 0;
    }
  }
  /// None flies in this sample, `steps` after the one before.
  void rest(int steps) noexcept {
    for (Flying& one : all_) {
      pass(one, steps);
      one.flies = false;
      one.unseen += steps;
    }
  }
  /// That one flies no more until as many samples have passed, and starts cold then.
  void send_to_rest(std::size_t i, int samples) noexcept { all_[i].rests = samples; }
  bool rests(std::size_t i) const noexcept { return all_[i].rests > 0; }
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
      pass(one, steps);
      one.flies = one.rests == 0 && (at_point || one.estimator->distance(now) <= 1.0);
      one.lap_ns = 0;
      if (!one.flies) one.unseen += steps;
    }
  }
  bool flies(std::size_t i) const noexcept { return all_[i].flies; }
  void predict(estimation::SensorMask available, const estimation::Conditions& before, int steps) noexcept {
    for (Flying& one : all_) {
      if (!one.flies) continue;
      const Lap lap(now_ns_, one.lap_ns);
      one.estimator->use(available);
      one.estimator->predict(before, steps + std::exchange(one.unseen, 0));
    }
  }
  void innovate(const estimation::SensorVector& y, const estimation::Conditions& now) noexcept {
    for (Flying& one : all_) {
      if (!one.flies) continue;
      const Lap lap(now_ns_, one.lap_ns);
      one.estimator->innovate(y, now);
    }
  }
  void update(estimation::SensorMask fused, std::int64_t hold) noexcept;
  /// All that fly, with the estimate that is published.
  void compare(const estimation::Estimate& published) noexcept {
    for (Flying& one : all_)
      if (one.flies && one.estimator->estimate().holds) one.tally.compare(one.estimator->estimate(), published);
  }
  const EstimatorTally& tally(std::size_t i) const noexcept { return all_[i].tally; }
  /// What it took in the present sample.
  std::int64_t lap_ns(std::size_t i) const noexcept { return all_[i].flies ? all_[i].lap_ns : 0; }
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
    std::unique_ptr<estimation::Estimator> estimator;
    EstimatorTally tally;
    int unseen = 0;           ///< samples that the next prediction leads over
    int rests = 0;            ///< for so many samples more
    std::int64_t lap_ns = 0;  ///< spent in the present sample
    bool flies = true;        ///< in the present sample
    bool went_on = false;
  };
  void add(std::string_view name, const estimation::Estimator& prototype) {
    all_.push_back({.estimator = prototype.clone(), .tally = EstimatorTally(name)});
  }
  static void pass(Flying& one, int steps) noexcept {
    if (one.rests == 0 || (one.rests = std::max(0, one.rests - steps)) > 0) return;
    one.estimator->reset();
    one.unseen = 0;
  }
  std::vector<Flying> all_;
  Stopwatch now_ns_ = nullptr;
};

}  // namespace ehm::monitor
