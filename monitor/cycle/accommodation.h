// SPDX-License-Identifier: Apache-2.0
#pragma once
// Fault accommodation: what the watch filter flies with. It takes the design for the sensors that are left, subtracts
// what a named fault has put into the estimate, and judges whether a sensor that was left out fits again before it
// returns. Nothing steps: what a lost sensor has taught fades over an hour.
// Real-time safe: yes, all but the constructor.

#include "monitor/checks/return_gate.h"
#include "monitor/cycle/fault_detection.h"
#include "monitor/cycle/sensor_supervision.h"
#include "monitor/data/events.h"
#include "monitor/design/design.h"
#include "monitor/estimation/tuner_estimator.h"

namespace ehm::monitor {

class Accommodation {
 public:
  explicit Accommodation(const design::Design& design) : sample_time_s_(design.model.sample_time_s) {}

  /// There is a design for the sensors that are left.
  bool has_design() const noexcept { return have_design_; }
  /// Finds that out from who is excluded, and tells when it changes.
  bool find_design(const estimation::TunerEstimator& watch, const SensorSupervision& supervision,
                   EventList& events) noexcept;
  /// Starts the watch filter cold with the sensors that are left; returns the one that is missing, -1: none.
  int start(estimation::TunerEstimator& watch, const SensorSupervision& supervision) noexcept;
  /// Makes the filter one of the sensors that are left, once there is a design for them, and takes out of it what the
  /// latest verdict has found.
  void respond(const Verdict& verdict, estimation::TunerEstimator& watch, FaultDetection& detection) noexcept;

  /// Judges the value of the sensor that is left out against its prediction, if it is plausible by itself, and writes
  /// its ratio. Returns it if it must stay out, else -1.
  int check_return(const estimation::TunerEstimator& watch, estimation::SensorMask plausible, bool shifted,
                   double gate_sigma, estimation::SensorVector& ratio) noexcept;

  /// Nothing is known of any sensor.
  void forget(EventList& events) noexcept;
  ReturnGate::Memory memory() const noexcept { return return_gate_.memory(); }
  /// Goes on where another one of the same design stopped.
  void resume(int missing, const ReturnGate::Memory& memory) noexcept;

 private:
  void await_return(const estimation::TunerEstimator& watch, int sensor) noexcept;
  void take_out(const FaultVerdict& fault, estimation::TunerEstimator& watch, const FaultDetection& detection) noexcept;
  void follow_return(const FaultVerdict& fault, estimation::TunerEstimator& watch, FaultDetection& detection) noexcept;
  void exclude(int sensor, const FaultVerdict& fault, estimation::TunerEstimator& watch,
               FaultDetection& detection) noexcept;
  void readmit(estimation::TunerEstimator& watch, FaultDetection& detection) noexcept;

  double sample_time_s_;
  bool have_design_ = true;
  int missing_ = -1;  ///< the only sensor that is excluded of those that a design needs; -1: none
  Condition no_design_;
  ReturnGate return_gate_;
  int gated_sensor_ = -1;     ///< whose return the gate judges
  bool cold_return_ = false;  ///< without it the filter has started cold: nothing to judge by until it has settled
  estimation::AugmentedVector shift_by_;
};

}  // namespace ehm::monitor
