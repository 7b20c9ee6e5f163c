#pragma once
// THE data path of one engine: check -> predict -> update, then judge. One sample in, one result out.
//
// The two parts may be called one by one, so that an estimate is on its way before it is judged: a fault that judging
// finds changes the estimates from the next sample on.
//
// Knows no DDS, clock, file, thread or log. Deterministic: the same samples give the same results to the bit.
// Equations: the filter in estimation/tuner_filter.h, its error in estimation/error_propagation.h, the decisions in
// checks/ and judge/.

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "monitor/checks/condition_check.h"
#include "monitor/checks/innovation_gate.h"
#include "monitor/checks/qualification.h"
#include "monitor/checks/return_gate.h"
#include "monitor/checks/sample_check.h"
#include "monitor/checks/sample_time_watch.h"
#include "monitor/checks/second_source_watch.h"
#include "monitor/checks/sensor_check.h"
#include "monitor/checks/sequence_watch.h"
#include "monitor/checks/stamp_watch.h"
#include "monitor/checks/validity.h"
#include "monitor/cycle/cycle_state.h"
#include "monitor/cycle/prepared_design.h"
#include "monitor/data/events.h"
#include "monitor/data/options.h"
#include "monitor/data/sample.h"
#include "monitor/design/design.h"
#include "monitor/estimation/error_propagation.h"
#include "monitor/estimation/tuner_filter.h"
#include "monitor/judge/fault_detector.h"
#include "monitor/judge/fleet_watch.h"
#include "monitor/judge/limit_watch.h"
#include "monitor/judge/shift_detector.h"
#include "monitor/judge/slow_bias.h"
#include "monitor/judge/ungated_filter.h"

namespace ehm::monitor {

/// What the cycle has counted since it was made.
struct CycleCounters {
  std::uint64_t received = 0;   ///< every sample that came
  std::uint64_t processed = 0;  ///< led to estimates
  std::uint64_t lost = 0;       ///< gaps of the sequence
  std::uint64_t duplicated = 0, reordered = 0, malformed = 0;
  std::uint64_t foreign = 0;  ///< from a second source of the same engine
  /// Accepted, but no honest estimate: off design, no design for the sensors left, too far from the fleet.
  std::uint64_t withheld = 0;
  std::uint64_t sensor_rejections = 0;  ///< values that were not fused; words of flight and actuators replaced
  std::uint64_t restarts = 0;
};

/// Result of one sample that was in order. Estimates are the filter's, in channel units.
struct CycleResult {
  bool estimates = false;   ///< estimates hold; where not, the reasons say why
  std::uint32_t flags = 0;  ///< idl::estimate_flag
  estimation::SensorMask sensors_used, rejected, fused;
  std::array<std::uint32_t, estimation::max_sensors> reason{};  ///< idl::reject_reason bits by sensor
  /// Sensor units, their squares, and the test ratio of the gate; all 0 where no filter ran.
  estimation::SensorVector innovation, innovation_variance, ratio;
};

class MonitorCycle {
 public:
  /// Shares the prepared design with all engines of its type.
  /// @throws std::invalid_argument if an option does not fit the design (names it).
  MonitorCycle(const PreparedDesign& prepared, const CycleOptions& options);
  /// For one engine of its type.
  MonitorCycle(std::shared_ptr<const design::Design> design, const CycleOptions& options)
      : MonitorCycle(PreparedDesign(std::move(design)), options) {}

  /// The whole path for one sample. False when it was dropped (duplicate, overtaken, malformed, foreign): the last
  /// result stands. Real-time safe: yes.
  bool process(const Sample& sample) noexcept {
    const bool in_order = estimate(sample);
    if (in_order) judge();
    return in_order;
  }
  /// Its first part: the estimates, their flags, and everything of the result but the reasons that judging adds.
  bool estimate(const Sample& sample) noexcept;
  /// Its second part, for a sample that was in order: faults, shifts, limits. Leaves the estimates alone.
  void judge() noexcept;
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
  /// yes.
  bool snapshot(CycleState& state) const noexcept;
  /// Goes on from `state` with the sample that is to be processed next; call on a cycle that has seen none, just before
  /// process. Refused, nothing is changed. Real-time safe: yes.
  Resumption resume(const CycleState& state, const Sample& next, double max_gap_s) noexcept;

  const estimation::TunerFilter& filter() const noexcept { return filter_; }
  const estimation::ErrorPropagation& error() const noexcept { return error_; }
  const design::Design& design() const noexcept { return *design_; }
  const FaultDetector& faults() const noexcept { return faults_; }
  const CycleCounters& counters() const noexcept { return counters_; }
  /// Goes on counting for a predecessor.
  void adopt(const CycleCounters& counters) noexcept { counters_ = counters; }
  const CycleOptions& options() const noexcept { return options_; }
  /// Of the latest sample that was in order.
  const CycleResult& result() const noexcept { return result_; }
  /// The source that is followed.
  std::uint32_t source_id() const noexcept { return sample_check_.source_id(); }
  /// Would a sample of this source and writer be dropped, since another one is followed?
  bool foreign(std::uint32_t source_id, std::uint64_t writer) const noexcept {
    return sample_check_.foreign(source_id, writer);
  }
  bool stale() const noexcept { return input_lost_.raised(); }
  /// Samples arrive, but their sequence number does not grow: none is in order.
  bool sequence_stands() const noexcept { return sequence_watch_.standing(); }
  /// The source's sequence numbers or stamps have a fault that an event tells.
  bool order_troubled() const noexcept { return sequence_watch_.raised() || stamp_watch_.raised(); }
  /// What may be wrong with the estimates, and an event tells: a drift, or a fault that nobody can name.
  bool doubted() const noexcept { return slow_bias_.raised() || ambiguous_.raised(); }
  /// Events since the last clear_events.
  const EventList& events() const noexcept { return events_; }
  void clear_events() noexcept { events_.clear(); }

 private:
  bool admit(const Sample& sample, SampleDecision& decision) noexcept;
  void restart(RestartReason reason, double jump_s) noexcept;
  void restart_filter() noexcept;
  void forget_sensors() noexcept;
  void await_return(int sensor) noexcept;
  int excluded_sensors(int& last) const noexcept;
  void check_sensors(const Sample& sample, int steps) noexcept;
  void watch_holds() noexcept;
  bool slow_start() const noexcept { return slowness_ > 1 && !error_.settled(); }
  void no_residuals() noexcept;
  void withhold() noexcept;
  void predict() noexcept;
  void gate() noexcept;
  std::pair<double, double> evidence(int sensor, std::uint32_t why) const noexcept;
  void qualify() noexcept;
  void update() noexcept;
  void conclude() noexcept;
  void detect() noexcept;
  void declare(const FaultVerdict& verdict) noexcept;
  void declare_sensor(const FaultVerdict& verdict) noexcept;
  void settle_ambiguity(bool decided) noexcept;
  void choose_design() noexcept;
  void exclude(int sensor) noexcept;
  void readmit() noexcept;
  void take_out_fault() noexcept;
  void follow_return() noexcept;
  void listen_anew() noexcept;
  std::uint32_t estimate_flags() const noexcept;
  /// `missing`: samples before `next` that never came.
  void fly_blind_to(const Sample& next, std::uint64_t missing) noexcept;

  std::shared_ptr<const design::Design> design_;
  CycleOptions options_;
  int sensors_, actuators_;
  std::shared_ptr<const std::vector<estimation::ErrorModel>> error_models_;  ///< [0] full set, [1 + i] without sensor i
  estimation::TunerFilter filter_;
  estimation::ErrorPropagation error_;

  SampleCheck sample_check_;
  SampleTimeWatch sample_time_;
  StampWatch stamp_watch_;
  SequenceWatch sequence_watch_;
  ConditionCheck condition_check_;
  SensorCheck sensor_check_;
  std::vector<Qualification> qualification_;
  std::vector<std::int64_t> gated_;  ///< values in a row that only the innovation gate held back, by sensor
  ReturnGate return_gate_;
  int gated_sensor_ = -1;     ///< whose return the gate judges
  bool cold_return_ = false;  ///< without it the filter has started cold: nothing to judge by until it has settled
  Validity validity_;
  UngatedFilter ungated_;
  FaultDetector faults_;
  FaultVerdict declared_;   ///< of this sample; taken out of the estimate at the next one
  bool came_back_ = false;  ///< what was declared is the end of a drift
  ShiftDetector shift_;
  SlowBias slow_bias_;
  FleetWatch fleet_;
  LimitWatch limits_;

  estimation::SensorVector dy_, sensor_trim_;  ///< deviations from trim, NaN where there is no value
  estimation::ActuatorVector du_, du_previous_, actuator_trim_;
  int steps_ = 1;                                 ///< sample times from the sample before to this one
  bool valid_ = true;                             ///< the design's point is near enough
  bool have_design_ = true;                       ///< for the sensors that are left
  Sample mended_;                                 ///< the latest sample, bad words of flight and actuators replaced
  bool usable_ = true;                            ///< there was something to replace them by
  std::int64_t slowness_ = 1, slow_samples_ = 0;  ///< longest hold that the design does not know; samples of it so far
  std::vector<Condition> sensor_fault_, slow_sensor_;
  Condition no_design_, input_lost_, ambiguous_;
  std::uint32_t dropped_ = 0;  ///< verdicts on what came since the last sample in order; bit i: SampleVerdict i
  SecondSourceWatch second_source_;
  std::uint32_t ambiguous_channel_ = 0;
  std::int64_t unambiguous_samples_ = 0;
  estimation::AugmentedVector shift_by_;
  EventList events_;
  CycleCounters counters_;
  CycleResult result_;
};

}  // namespace ehm::monitor
