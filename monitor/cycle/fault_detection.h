// SPDX-License-Identifier: Apache-2.0
#pragma once
// The last station of the data path: what the estimates of a sample mean. Names abrupt faults of sensors and
// components, shifts of health, slow bias of a sensor. It leaves the sample's estimates alone; what it decides about a
// sensor is a Verdict, a value that accommodation takes before the next sample.
// Real-time safe: yes, all but the constructor.

#include <cstdint>

#include "monitor/cycle/cycle_result.h"
#include "monitor/cycle/prepared_design.h"
#include "monitor/cycle/sensor_supervision.h"
#include "monitor/data/events.h"
#include "monitor/data/options.h"
#include "monitor/diagnosis/fault_detector.h"
#include "monitor/diagnosis/noise_watch.h"
#include "monitor/diagnosis/shift_detector.h"
#include "monitor/diagnosis/slow_bias.h"
#include "monitor/diagnosis/ungated_filter.h"
#include "monitor/estimation/tuner_estimator.h"

namespace ehm::monitor {

/// What a sample's judgement decides about the estimates from the next one on.
struct Verdict {
  FaultVerdict fault;       ///< that is to be taken out of the estimate; kind none: nothing is
  bool ends_drift = false;  ///< it is the end of a drift that the filter has followed: the sensor is good again
};

class FaultDetection {
 public:
  FaultDetection(const CycleOptions& options, const PreparedDesign& prepared);

  /// Judges the sample that `watch` was last updated with, `steps` sample times after the one before; adds the reasons
  /// of a sensor that it names. With `has_design` false the estimates mean nothing.
  Verdict diagnose(const estimation::TunerEstimator& watch, bool has_design, int steps, SensorSupervision& supervision,
                   CycleResult& result, EventList& events) noexcept;

  /// The engine flies on where the watch filter's model does not hold: what it has found and not settled ends.
  void leave_point(EventList& events) noexcept;
  /// Where the watch filter's model does not hold: the step of health, the bias of a sensor, or what may be either, that
  /// the published estimator has found by itself; and a sensor whose noise has grown against its innovations. Excludes
  /// the sensor. @returns which has been excluded for a bias now; -1: none.
  int follow(const estimation::Estimate& published, const estimation::Innovation& innovation,
             SensorSupervision& supervision, CycleResult& result, EventList& events) noexcept;

  /// The watch filter starts cold, without sensor `missing` (-1: with all).
  void restart(int missing, EventList& events) noexcept;
  /// It goes on where another one of its design stopped; deaf for so many samples.
  void resume(int missing, Eigen::Index deaf_samples) noexcept;
  /// It goes on without a sensor.
  void without(int sensor) noexcept;
  /// It goes on with all sensors, and with what is still wrong with its state.
  void with_all() noexcept;
  /// The estimates step for a reason that is known.
  void expect_step() noexcept { shift_.reset(); }

  /// It listens: the filter has converged.
  bool listens() const noexcept { return detector_.armed(); }
  /// The sensor that is most likely at fault, -1 for none: better not fused.
  int suspect() const noexcept { return detector_.suspect(); }
  /// Beyond the point: the sensors whose noise is too large.
  estimation::SensorMask loud() const noexcept { return loud_; }
  bool shifted() const noexcept { return shift_.raised(); }
  /// What may be wrong with the estimates, and an event tells: a drift, or a fault that nobody can name.
  bool doubted() const noexcept { return slow_bias_.raised() || ambiguous_.raised(); }
  const FaultDetector& detector() const noexcept { return detector_; }
  /// Adds to a shift of the watch filter's state what the gate has kept from it.
  void add_ungated(estimation::AugmentedVector& shift) const noexcept { ungated_.add_difference(shift); }

 private:
  Verdict declare(const FaultVerdict& fault, bool all_sensors, SensorSupervision& supervision, CycleResult& result,
                  EventList& events) noexcept;
  Verdict declare_sensor(const FaultVerdict& fault, bool all_sensors, SensorSupervision& supervision,
                         CycleResult& result, EventList& events) noexcept;
  void follow_noise(const estimation::Innovation& innovation, SensorSupervision& supervision, CycleResult& result,
                    EventList& events) noexcept;
  void settle_ambiguity(bool decided, EventList& events) noexcept;
  double age_s(const FaultVerdict& fault) const noexcept { return sample_time_s_ * (fault.age + 1); }

  double sample_time_s_, slowest_time_constant_s_;
  FaultDetector detector_;
  NoiseWatch published_noise_;   ///< beyond the point
  estimation::SensorMask loud_;  ///< by it
  UngatedFilter ungated_;
  ShiftDetector shift_;
  SlowBias slow_bias_;
  Condition ambiguous_, published_step_;
  std::uint32_t ambiguous_channel_ = 0, stepped_channel_ = 0;
  std::int64_t unambiguous_samples_ = 0;
};

}  // namespace ehm::monitor
