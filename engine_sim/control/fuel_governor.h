#pragma once
// Holds the fan speed by fuel flow: proportional-integral in velocity form, so that limits cannot wind it up.
//
//   e[k]  = n1_demand - n1[k]                                  rpm
//   Wf[k] = Wf[k-1] + kp (e[k] - e[k-1]) + ki e[k] dt          kg/s, limited in slew and range
//
// Gains are relative: kp in (kg/s per kg/s of trim) per (rpm per rpm of trim). The pole of the default gains with the
// JT9D-class engine at cruise lies near 1 s, so a throttle change settles in some 4 s without overshoot.
// The governor sees the true shaft speed: its own speed pick-up is not one of the monitored sensors.

namespace ehm::engine {

struct GovernorOptions {
  double proportional = 2.0;       ///< relative fuel per relative speed error
  double integral_per_s = 2.0;     ///< relative fuel per relative speed error and second
  double slew_per_s = 0.3;         ///< of trim fuel flow per second
  double fuel_min_of_trim = 0.15;  ///< flame-out side
  double fuel_max_of_trim = 1.25;  ///< T40 side
};

class FuelGovernor {
 public:
  /// Starts in balance: `fuel_flow_kg_s` holds `n1_rpm`; both are the scale of the gains.
  FuelGovernor(const GovernorOptions& options, double n1_rpm, double fuel_flow_kg_s);
  /// Fuel flow that acts from now until the next call.
  double update(double n1_demand_rpm, double n1_rpm, double dt_s);

 private:
  GovernorOptions options_;
  double n1_scale_rpm_;
  double fuel_scale_kg_s_;
  double fuel_flow_kg_s_;
  double last_error_ = 0.0;
};

}  // namespace ehm::engine
