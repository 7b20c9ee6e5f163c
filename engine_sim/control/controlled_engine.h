// SPDX-License-Identifier: Apache-2.0
#pragma once
// An engine and its control, one sample after another: measurements -> control -> actuators -> gas path -> spools.
//   measured at sample k: speeds and flight condition of k, T48 and Ps30 of the gas path of k - 1
//   fuel flow and geometry of sample k act from k to k + 1 and are in the gas path of k
// dt in s as in transient.h. Errors: those of Transient.

#include "engine_sim/control/engine_control.h"
#include "engine_sim/control/scheduled_point.h"
#include "engine_sim/model/solve/transient.h"

namespace ehm::engine_sim {

struct ControlledSample {
  Actuation actuation;
  Geometry geometry;  ///< as the gas path felt it: vanes off their schedule
  GasPath gas;
};

class ControlledEngine {
 public:
  /// `start` has vanes and valves on their schedules, see scheduled_point.h.
  ControlledEngine(const Turbofan& engine, const ControlData& data, const SteadyPoint& start,
                   HeatSoak heat_soak = HeatSoak::without, Motion motion = Motion::smooth);

  /// The sample of now, and on to the next one.
  ControlledSample step(const Surroundings& surroundings, double n1_demand_rpm, double dt_s);
  /// Adds what no control and no equation brings to the speeds of the next sample.
  void disturb(const SpoolSpeeds& change_rpm) { transient_.disturb(change_rpm); }
  SpoolSpeeds speeds() const { return transient_.speeds(); }

 private:
  const Turbofan& engine_;
  EngineControl control_;
  Transient transient_;
  Measurements measured_;
};

}  // namespace ehm::engine_sim
