// SPDX-License-Identifier: Apache-2.0
#pragma once
// THE data path of one engine: one sample in, one result out.
//
//   intake -> supervision (each value by itself) -> valid here? -> accommodation (which design) -> predict -> gate and
//   qualify -> update -> does such an engine exist? -> CycleResult;     then detection: what it means -> Verdict, which
//   accommodation takes before the next sample
//
// The two parts may be called one by one, so that an estimate is on its way before it is judged: a fault that judging
// finds changes the estimates from the next sample on. Each station is a file of its own; this one only leads from one
// to the next. The watch filter is the tuner filter, whichever estimator is published. Where its model does not hold
// and the published estimator's does, that one goes on alone and its innovations gate the readings; it names steps of
// health and biased sensors by itself; the fleet is judged by the watch filter only.
//
// Knows no DDS, clock, file, thread or log. Deterministic: the same samples give the same results to the bit.

#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "deploy/runtime/numbers/index.h"
#include "monitor/checks/bias_return.h"
#include "monitor/checks/validity.h"
#include "monitor/cycle/accommodation.h"
#include "monitor/cycle/companion_estimators.h"
#include "monitor/cycle/cycle_result.h"
#include "monitor/cycle/cycle_state.h"
#include "monitor/cycle/estimator_fallback.h"
#include "monitor/cycle/fault_detection.h"
#include "monitor/cycle/prepared_design.h"
#include "monitor/cycle/sample_intake.h"
#include "monitor/cycle/sensor_supervision.h"
#include "monitor/data/options.h"
#include "monitor/diagnosis/fleet_watch.h"
#include "monitor/diagnosis/limit_watch.h"
#include "monitor/estimation/tuner_estimator.h"

namespace ehm::monitor {

/// What became of an order to publish another estimator.
enum class Publishing { done, already, not_flying, no_answer };

class MonitorCycle {
 public:
  /// Shares the prepared design, made with the same estimator options, with all engines of its type.
  /// @throws std::invalid_argument if an option does not fit the design (names it).
  MonitorCycle(const PreparedDesign& prepared, const CycleOptions& options);
  /// For one engine of its type.
  MonitorCycle(std::shared_ptr<const design::Design> design, const CycleOptions& options)
      : MonitorCycle(PreparedDesign(std::move(design), options), options) {}

  /// The whole path for one sample. False when it was dropped (duplicate, overtaken, malformed, foreign): the last
  /// result stands. Real-time safe: yes.
  bool process(const Sample& sample) noexcept {
    const bool taken = estimate(sample);
    if (taken) diagnose();
    return taken;
  }
  /// Its first part: the estimates, their flags, and everything of the result but the reasons that judging adds.
  bool estimate(const Sample& sample) noexcept;
  /// Its second part, for a sample that was in order: faults, shifts, limits. Leaves the estimates alone.
  void diagnose() noexcept;
  /// Could a filter begin with this sample: its shape is the design's, and a sensor has a value? Real-time safe: yes.
  bool usable(const Sample& sample) const noexcept;
  /// Tells that no sample has come for `age_s`; raises input_lost once that exceeds the stale limit. True if it does.
  /// Real-time safe: yes.
  bool no_input(double age_s) noexcept;
  /// Cold start of the filter, by an operator's order, or since another design takes over. After an order sensors that
  /// were named faulty stay out until they requalify. Real-time safe: yes.
  void reset(RestartReason reason = RestartReason::command) noexcept;
  /// Another cycle takes over with another design: ends every condition that this one has raised. Real-time safe: yes.
  void retire() noexcept;

  /// What a successor needs to go on from here. False, and nothing written, without an honest estimate. Real-time safe:
  /// yes, into a state with as many companions.
  bool snapshot(CycleState& state) const noexcept;
  /// Goes on from `state` with the sample that is to be processed next; call on a cycle that has seen none, just before
  /// process. Refused, nothing is changed. Real-time safe: yes.
  Resumption resume(const CycleState& state, const Sample& next, double max_gap_s) noexcept;

  /// After resume(): the configured estimator has gone on from a state of its own.
  bool published_went_on() const noexcept {
    return configured_ == watch_filter || companions_.went_on(as_size(configured_));
  }

  /// The configured estimator's, whichever is published at present (estimator.h): what this flight has taught, what it
  /// begins with, and that it is over. Nothing where that is the watch filter. Real-time safe: yes.
  estimation::Learned learned() const noexcept {
    return configured_ == watch_filter ? estimation::Learned{} : companions_.learned(as_size(configured_));
  }
  bool begin_with(const estimation::Learned& known, double wear_percent) noexcept {
    return configured_ != watch_filter && companions_.begin_with(as_size(configured_), known, wear_percent);
  }
  void next_flight(double wear_percent) noexcept {
    if (configured_ != watch_filter) companions_.next_flight(as_size(configured_), wear_percent);
  }

  /// The estimates of `name` (of the table of estimators) are published from the next sample on, if it flies and has an
  /// answer now: it goes on as it is, and the one before goes on beside it. Refused, nothing is changed. Real-time
  /// safe: yes.
  Publishing publish(std::string_view name) noexcept;
  std::string_view published() const noexcept;

  /// For who has a clock: what each companion takes is measured by it from now on. Null: nothing is.
  void measure(Stopwatch now_ns) noexcept { companions_.measure(now_ns); }
  const CompanionEstimators& companions() const noexcept { return companions_; }
  /// The estimators that fly, with the published one last compared: the watch filter, where others fly beside it, and
  /// they. `visit(const EstimatorTally&)`.
  template <class Visit>
  void for_each_tally(Visit&& visit) const {
    if (companions_.size() > 0) visit(watch_tally_);
    for (std::size_t i = 0; i < companions_.size(); ++i) visit(companions_.tally(i));
  }
  /// That companion has overrun its budget by what the event says: it rests (companion_estimators.h). Where it is
  /// published, its fallback follows. Real-time safe: yes.
  void rest(std::size_t companion, double took_us, double budget_us) noexcept;

  /// Of the latest sample that was in order.
  const CycleResult& result() const noexcept { return result_; }
  const design::Design& design() const noexcept { return *design_; }
  const CycleOptions& options() const noexcept { return options_; }
  /// Estimators in result().shadow.
  int shadows() const noexcept { return static_cast<int>(shadows_.size()); }
  const estimation::TunerEstimator& watch() const noexcept { return watch_; }
  const SampleIntake& intake() const noexcept { return intake_; }
  /// Sample times from the sample before to the latest; 1 after a restart.
  int steps() const noexcept { return steps_; }
  /// How far the latest sample is from where the published estimator holds; above 1 it does not.
  double distance() const noexcept { return distance_; }
  const FaultDetection& detection() const noexcept { return detection_; }
  const CycleCounters& counters() const noexcept { return counters_; }
  /// Goes on counting for a predecessor.
  void adopt(const CycleCounters& counters) noexcept { counters_ = counters; }
  bool stale() const noexcept { return intake_.stale(); }
  /// Events since the last clear_events.
  const EventList& events() const noexcept { return events_; }
  void clear_events() noexcept { events_.clear(); }

 private:
  void restart(RestartReason reason, double jump_s) noexcept;
  void restart_filter() noexcept;
  void restart_at_point() noexcept;
  void restart_watch() noexcept;
  double distance_of_published() const noexcept;
  bool watch_holds(bool was_at_point) noexcept;
  void fuse_beyond_the_point() noexcept;
  GateDecision gate_beyond_the_point(estimation::SensorMask in_use) const noexcept;
  void note_fused(estimation::SensorMask in_use) noexcept;
  void take_estimates() noexcept;
  void note_rest() noexcept;
  Event overrun_of(std::size_t companion, double took_us, double budget_us) const noexcept;
  void compare_estimators() noexcept;
  bool flies(int estimator) const noexcept {
    return estimator == watch_filter ? valid_ && at_point_ : companions_.flies(as_size(estimator));
  }
  estimation::Conditions conditions_of(const Sample& sample) const noexcept;
  bool choose_design() noexcept;
  void fuse(bool has_design) noexcept;
  void conclude(bool has_design) noexcept;
  void withhold() noexcept;
  void no_residuals() noexcept;
  std::uint32_t estimate_flags() const noexcept;
  std::string_view name_of(int estimator) const noexcept {
    return estimator == watch_filter ? design::tuner_name : companions_.tally(as_size(estimator)).name;
  }
  const estimation::Estimate& estimate_of(int estimator) const noexcept {
    return estimator == watch_filter ? watch_.estimate() : companions_.estimate(as_size(estimator));
  }

  std::shared_ptr<const design::Design> design_;
  CycleOptions options_;
  int sensors_, actuators_;
  estimation::TunerEstimator watch_;
  CompanionEstimators companions_;
  int configured_;                             ///< whose estimate is published at first: a companion, or watch_filter
  int published_;                              ///< and at present
  std::vector<int> shadows_;                   ///< the same of the shadows
  std::vector<estimation::SensorSpan> spans_;  ///< of the companions
  std::vector<Condition> resting_;             ///< of the companions
  EstimatorTally watch_tally_{design::tuner_name};

  SampleIntake intake_;
  SensorSupervision supervision_;
  Validity validity_;  ///< of the published estimator
  Within point_;       ///< of the watch filter
  Accommodation accommodation_;
  BiasReturn bias_return_;  ///< beyond the point
  FleetWatch fleet_;
  FaultDetection detection_;
  LimitWatch limits_;
  EstimatorFallback fallback_;  ///< at the point

  estimation::Conditions before_, now_;  ///< at the sample before, and at this one
  int steps_ = 1;                        ///< sample times between the two
  double distance_ = 0.0;                ///< of the published estimator, at the present one
  bool valid_ = true;                    ///< the published estimator's model holds here
  bool at_point_ = true;                 ///< the watch filter's does
  double inside_s_ = 0.0;                ///< for so long the conditions have been those of its point
  Verdict verdict_;                      ///< on this sample, for the next one
  EventList events_;
  CycleCounters counters_;
  CycleResult result_;
};

}  // namespace ehm::monitor
