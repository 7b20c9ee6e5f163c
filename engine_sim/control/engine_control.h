// SPDX-License-Identifier: Apache-2.0
#pragma once
// The control of one engine, once a sample: measurements and a fan speed demand to fuel flow, stator vanes and bleed
// valves. The actuators are part of it; what it returns are their positions.
//   vanes:   schedule of N2 corrected, lag and rate of the actuator
//   valves:  the larger of a schedule of N2 corrected (low power) and one of the ratio units as a multiple of the
//            deceleration schedule: where the fuel is cut, the core slows before the fan and swallows less than the LPC
//            delivers; limited in rate
//   fuel:    fuel_control.h
// Source: Walsh & Fletcher, chapters 5 and 8 (variable geometry, handling bleed). Errors: none. Real-time safe: yes.

#include "engine_sim/control/actuator.h"
#include "engine_sim/control/fuel_control.h"
#include "engine_sim/control/measurements.h"
#include "engine_sim/engines/control_data.h"

namespace ehm::engine_sim {

/// What the control has set.
struct Actuation {
  double fuel_flow_kg_s = 0.0;
  double vsv_deg = 0.0;       ///< vane angle, not the deviation from the schedule
  double vbv_fraction = 0.0;  ///< of the LPC's exit flow
  FuelLoop active = FuelLoop::n1_governor;
};

class EngineControl {
 public:
  /// Starts in balance with vanes and valves where their schedules want them.
  EngineControl(const ControlData& data, const Measurements& start, double fuel_flow_kg_s);

  Actuation update(const Measurements& measured, double n1_demand_rpm, double dt_s);
  const ControlData& data() const { return data_; }

 private:
  ControlData data_;
  FuelControl fuel_;
  Actuator vanes_, valves_;
};

/// Where the bleed valves of this engine are commanded.
double bleed_valve_command(const ControlData& data, const Measurements& measured, double fuel_flow_kg_s);

/// What the model takes of an actuation: the vanes' deviation from the schedule at the true speeds.
Geometry geometry(const VaneControlData& vanes, const Actuation& actuation, const Measurements& truth);

}  // namespace ehm::engine_sim
