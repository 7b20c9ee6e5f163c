// SPDX-License-Identifier: Apache-2.0
#pragma once
// The second station of the data path: which sensors may be fused. Each value is checked by itself, then against its
// prediction; who is bad for a few samples is bridged, for longer excluded, and comes back after as many good ones.
// The reasons of each sensor are those of CycleResult. Real-time safe: yes, all but the constructor.

#include <cstdint>
#include <utility>
#include <vector>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/linear_model.h"
#include "monitor/checks/innovation_gate.h"
#include "monitor/checks/qualification.h"
#include "monitor/checks/sensor_check.h"
#include "monitor/cycle/cycle_result.h"
#include "monitor/data/events.h"
#include "monitor/data/options.h"
#include "monitor/data/sample.h"
#include "monitor/estimation/estimator.h"

namespace ehm::monitor {

/// What the gate is told beside the innovations.
struct GateContext {
  int held_back = -1;                ///< a sensor that is left out and does not yet fit its prediction
  estimation::SensorMask loud = {};  ///< whose noise is still too large
  int suspect = -1;                  ///< most likely at fault, while nothing has been named
  bool detector_listens = false;     ///< what stays wild is its to name, not the gate's to keep out
};

class SensorSupervision {
 public:
  /// @throws std::invalid_argument if an option names no sensor of the model.
  SensorSupervision(const CycleOptions& options, const linear_model::LinearModel& model,
                    const estimation::SensorSpan& span);

  /// Checks each value by itself, `steps` sample times after the one before; sets the reasons.
  void check(const Sample& sample, int steps, CycleResult& result, EventList& events) noexcept;
  /// Another estimator is published, which holds elsewhere.
  void use(const estimation::SensorSpan& span) noexcept { sensor_check_.use(span); }
  /// The values of that sample, NaN where there is none.
  const estimation::SensorVector& values() const noexcept { return values_; }
  /// For how many samples the slowest of the sensors that the design takes for fast ones holds its values; 1 for most.
  std::int64_t hold() const noexcept { return hold_; }

  /// Sensors without a reason so far.
  estimation::SensorMask plausible(const CycleResult& result) const noexcept;
  /// Adds the reason innovation_gate: to what `gate` rejects, until the detector is to judge it, and to whom the
  /// context keeps out.
  void gate(const GateDecision& gate, const GateContext& context, CycleResult& result) noexcept;
  /// Who is bridged, excluded, back; adds the reason excluded.
  void qualify(bool detector_listens, CycleResult& result, CycleCounters& counters, EventList& events) noexcept;

  bool excluded(int sensor) const noexcept {
    return qualification_[as_size(sensor)].state() == Qualification::State::excluded;
  }
  /// All that are not excluded.
  estimation::SensorMask available() const noexcept;
  /// A fault was found, `event` tells it: the sensor is excluded until it requalifies.
  void exclude(int sensor, const Event& event, EventList& events) noexcept;
  /// Nothing is known of any sensor: another source, or another design.
  void forget(EventList& events) noexcept;
  /// Another source or time: nothing is compared with what came before.
  void forget_values() noexcept { sensor_check_.reset(); }
  /// Another design takes over.
  void retire(EventList& events) noexcept;

 private:
  void watch_holds(EventList& events) noexcept;
  std::pair<double, double> evidence(int sensor, const CycleResult& result) const noexcept;

  CheckOptions options_;
  double sample_time_s_;
  int sensors_;
  SensorCheck sensor_check_;
  std::vector<Qualification> qualification_;
  std::vector<std::int64_t> gated_;  ///< values in a row that only the innovation gate held back, by sensor
  std::vector<Condition> sensor_fault_, slow_sensor_;
  estimation::SensorVector values_;
  std::int64_t hold_ = 1;
};

}  // namespace ehm::monitor
