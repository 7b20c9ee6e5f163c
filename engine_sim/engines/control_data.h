// SPDX-License-Identifier: Apache-2.0
#pragma once
// Everything that the control of one engine needs to know of it. Corrected speeds are N/sqrt(theta2) in rpm, ratio
// units are those of measurements.h. Errors: none. Source of a particular engine's numbers: its file.

#include "engine_sim/engines/schedule.h"

namespace ehm::engine_sim {

/// A position servo (control/actuator.h).
struct ActuatorData {
  double lag_s;
  double rising_per_s, falling_per_s;  ///< largest rates, both positive
};

/// What the engine may not exceed, whatever is demanded.
struct EngineLimits {
  double n1_rpm, n1_corrected_rpm;
  double n2_rpm, n2_corrected_rpm;
  double t48_k;
  double ps_30_pa;
  double ground_idle_n2_corrected_rpm, flight_idle_n2_corrected_rpm;  ///< least corrected core speed

  double idle_n2_corrected_rpm(bool on_ground) const {
    return on_ground ? ground_idle_n2_corrected_rpm : flight_idle_n2_corrected_rpm;
  }
};

/// How a measured quantity answers relative fuel flow at constant flight condition, as one lag (linear model):
///   d ln y / d ln Wf = gain/(1 + lag s),  lag = lag_s_at_sea_level/delta2
/// The lag goes with 1/delta2, because power does and inertia does not.
struct FuelResponse {
  double gain;
  double lag_s_at_sea_level;
};

struct FuelControlData {
  /// Speeds answer by fan speed: gain and lag over N1 corrected.
  Schedule n1_gain, n1_lag_s, n2_gain, n2_lag_s;
  FuelResponse t48, ps_30;
  double speed_bandwidth_rad_s, t48_bandwidth_rad_s, ps_30_bandwidth_rad_s;
  double reference_band;                ///< relative to the demand: within it the reference of the governor is led
  double reference_fuel_rate_per_s;     ///< so that its proportional part asks for this relative rate of fuel flow
  Schedule acceleration, deceleration;  ///< largest and least ratio units over N2 corrected
  double theta_exponent;                ///< m of the ratio units
  double slew_per_s;                    ///< fastest relative change of fuel flow
  double fuel_min_kg_s, fuel_max_kg_s;  ///< range of the metering valve
};

/// Stator vanes: degrees over N2 corrected, positive closed.
struct VaneControlData {
  Schedule schedule_deg;
  ActuatorData actuator;
};

/// Bleed valves: fraction of the LPC's exit flow.
struct BleedValveControlData {
  Schedule low_speed;     ///< over N2 corrected
  Schedule deceleration;  ///< over ratio units as a multiple of the deceleration schedule
  ActuatorData actuator;
};

struct ControlData {
  EngineLimits limits;
  bool hold_limits = true;  ///< false: N1, N2, T48 and Ps30 may pass theirs; idle and the schedules still act
  FuelControlData fuel;
  VaneControlData vanes;
  BleedValveControlData bleed_valves;
  double middle_n1_corrected_rpm;  ///< inside the range at any flight condition: searches for a start begin there
};

}  // namespace ehm::engine_sim
