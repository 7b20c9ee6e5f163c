// SPDX-License-Identifier: Apache-2.0
#pragma once
// What an operator may set of the data path; monitor/service/config.h gives each its range, unit and description.

#include <cstdint>
#include <string>
#include <vector>

namespace ehm::monitor {

struct CheckOptions {
  std::int64_t source_id = 0;            ///< the only source that is followed; 0: the first that speaks
  double range_percent = 60.0;           ///< a sensor farther from its trim is out of range, percent of trim
  double rate_percent = 12.0;            ///< a larger step between samples is impossible, percent of trim
  std::int64_t stuck_samples = 20;       ///< fewer equal values in a row are never a stuck channel
  double gate_sigma = 5.0;               ///< innovation gate; 5 sigma closes falsely once in 1.7 million values
  std::int64_t bridge_samples = 5;       ///< bad samples in a row that are bridged before the sensor is declared faulty
  std::int64_t requalify_samples = 200;  ///< good samples in a row before it is used again
  double restart_gap_s = 2.0;            ///< a longer gap, or a larger jump back in time, restarts the filter
  friend bool operator==(const CheckOptions&, const CheckOptions&) = default;
};

/// What an operator knows of one sensor (checks/stuck_watch.h).
struct SensorOptions {
  std::string name;
  std::int64_t stuck_samples = -1;  ///< as many equal values in a row are stuck; 0: never; -1: by its kind
  double resolution = -1.0;         ///< step of its values, channel unit; -1: the model's
  friend bool operator==(const SensorOptions&, const SensorOptions&) = default;
};

/// How far from the design's operating point its linear model is trusted.
struct ValidityOptions {
  double altitude_m = 600.0;
  double mach = 0.04;
  double delta_isa_k = 6.0;
  double actuator_percent = 15.0;  ///< of trim, where that is not zero
  double vane_deg = 3.0;           ///< of an actuator in degrees
  double bleed_fraction = 0.03;    ///< of an actuator in fractions of a flow
  friend bool operator==(const ValidityOptions&, const ValidityOptions&) = default;
};

struct ShiftOptions {
  double window_s = 4.0;       ///< the estimate is compared with itself this long ago
  double persistence_s = 1.0;  ///< the change must last this long before it is named
  double false_alarm_per_hour = 1e-3;
  friend bool operator==(const ShiftOptions&, const ShiftOptions&) = default;
};

/// Detection of abrupt sensor and component faults, and of slow bias.
struct FaultOptions {
  double false_alarm_per_hour = 0.02;    ///< by noise, of all abrupt faults together
  double persistence_s = 0.075;          ///< the same answer so long before it is given
  double decide_within_s = 2.0;          ///< then "ambiguous" is the answer
  double wrong_name_probability = 1e-3;  ///< of sensor against component, sensor against sensor
  double signature_error = 0.1;          ///< share of the evidence that a wrong model may turn
  double slow_bias_probability = 1e-6;   ///< per engine of the fleet, that wear alone looks like a slow bias
  friend bool operator==(const FaultOptions&, const FaultOptions&) = default;
};

/// How far from the fleet's mean an estimate is believed (diagnosis/fleet_watch.h).
struct FleetOptions {
  double warn_sigma = 5.0;       ///< of the prior: farther out a warning; one engine in 1.7 million stands there
  double withhold_sigma = 10.0;  ///< farther out no estimate
  double persistence_s = 1.0;    ///< before either
  friend bool operator==(const FleetOptions&, const FleetOptions&) = default;
};

/// Raised when the estimate leaves [min, max]; cleared when it is back inside by `hysteresis`.
struct LimitOptions {
  std::string quantity;  ///< name of a health or auxiliary channel
  double min, max, hysteresis;
  friend bool operator==(const LimitOptions&, const LimitOptions&) = default;
};

/// Which estimators fly (design/make_estimator.h has the table of their names).
struct EstimatorOptions {
  std::string published = "tuner";  ///< whose estimates go out as EngineHealth and EngineAuxiliary
  std::string shadow;               ///< whose go out under their own names beside them, with commas between
  double budget_ms = 7.5;           ///< what one may take for a sample; 0: without limit
  double memory_s = 3600.0;         ///< of gauss_markov, rls: in which they forget
  std::string engine;               ///< of onboard and the nonlinear filters: name or file; empty: the design's
  std::string mismatch = "all";     ///< of onboard: which causes it looks for (mismatch_choices)
  double lag_speed_s = 0.02, lag_pressure_s = 0.04, lag_temperature_s = 0.7;  ///< of onboard, where its file has none
  std::string noise_of = "reading";   ///< of onboard: what the percents of noise are of, or "trim": the design's sigmas
  double health_walk_percent = 1e-4;  ///< of the nonlinear filters: what health may change by within 15 ms
  std::int64_t iterations = 5;        ///< of iekf, at most
  double box_sigma = 4.0;             ///< of clipped_ekf and cekpf: bounds of health, in sigmas of the fleet
  std::string sigma_points = "symmetric", unscented_form = "additive";        ///< of ukf
  std::int64_t particles = 50;                                                ///< of particle, ekpf, cekpf
  std::string particle_weights = "likelihood", particle_jacobian = "shared";  ///< of ekpf, cekpf
  std::string constrained_of = "time_varying";  ///< of constrained: whose estimates it constrains
  std::string constraint = "projection";        ///< of constrained: how (constraint_choices)
  double constraint_margin_sigma = 3.0;         ///< of constrained: how far behind the estimate its bound stays
  bool constraint_feeds_back = false;           ///< of constrained: the one inside goes on from the constrained health
  std::string wear_raises;  ///< of constrained: names of what wear raises, with commas between; empty: turbines' flows
  friend bool operator==(const EstimatorOptions&, const EstimatorOptions&) = default;
};

struct CycleOptions {
  EstimatorOptions estimator;
  CheckOptions checks;
  ValidityOptions validity;
  ShiftOptions shift;
  FaultOptions faults;
  FleetOptions fleet;
  std::vector<LimitOptions> limits;
  std::vector<SensorOptions> sensors;
  double stale_periods = 3.0;  ///< sample times without input, after which it counts as lost
  friend bool operator==(const CycleOptions&, const CycleOptions&) = default;
};

}  // namespace ehm::monitor
