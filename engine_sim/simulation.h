#pragma once
// One simulated engine in flight: profile -> control -> gas path -> sensors, one sample after another. No clock, no
// DDS.
//
// Sample k is taken at t = k dt. The fuel flow of sample k acts from t to t + dt, and its direct effect on pressures
// and temperatures is in the readings of sample k: u[k] of THEORY.md section 4.
// A demand out of reach is no error: the control's limits hold the engine. Only the start is the caller's to choose.
// @throws FlightError when the first demand or the flight leaves no running engine; the message says when, where, what
// was demanded, and which balance does not close.

#include <array>
#include <cstdint>
#include <stdexcept>

#include "engine_sim/control/controlled_engine.h"
#include "engine_sim/control/fan_speed_demand.h"
#include "engine_sim/scenario/deterioration.h"
#include "engine_sim/scenario/flight_profile.h"
#include "engine_sim/scenario/scenario.h"

namespace ehm::engine {

struct SimSample {
  std::uint64_t sequence = 0;
  double time_s = 0.0;
  FlightCondition flight;
  Actuation actuation;
  Geometry geometry;  ///< as the gas path felt it: vanes off their schedule
  std::array<Reading, sensor_count> readings{};
  HealthVector health{};
  std::array<double, auxiliary_count> auxiliary{};
};

class FlightError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Simulation {
 public:
  explicit Simulation(const Scenario& scenario);

  /// The next sample; the first is at t = 0 with the engine in balance.
  SimSample next();

  double time_s() const { return static_cast<double>(sequence_) * scenario_.sample_time_s; }
  /// New engine at the start of the flight: trim of the sensors' noise, and of the description.
  const GasPath& nominal() const { return nominal_.gas; }
  const Geometry& nominal_geometry() const { return nominal_.operation.geometry; }
  double noise_sigma(std::size_t sensor) const { return sensors_.noise_sigma(sensor); }

  /// `demand`: n1_rpm or net_thrust_n
  void demand(const Demand& demand) { profile_.override_demand(demand); }
  void fly(const FlightCondition& flight) { profile_.override_flight(flight); }
  /// Moves a health parameter to `target` within ramp_s, from now on.
  void order_health(std::size_t parameter, double target, double ramp_s) {
    deterioration_.order(parameter, target, ramp_s, time_s());
  }
  /// The most that a demand of net thrust can get where the engine flies now (fan_speed_demand.h).
  double most_net_thrust_n() const;
  /// Does the engine go on running for a second, if the flight condition jumps there now?
  bool can_fly(const FlightCondition& flight) const;
  /// Does it go on running for three seconds, if a health parameter moves there within ramp_s (a second at most here)?
  bool can_wear(std::size_t parameter, double target, double ramp_s) const;
  HealthVector health() const { return deterioration_.at(time_s()); }
  void inject(std::size_t sensor, const SensorFault& fault) { sensors_.inject(sensor, fault); }

 private:
  /// Flies a copy on for so long, under the flight condition and with the health of each moment from now.
  template <class Flight, class Health>
  bool survives(double seconds, Flight flight, Health health_at) const;
  ControlledSample step(const ProfilePoint& now, const HealthVector& health);

  Scenario scenario_;
  Turbofan turbofan_;
  SteadyPoint nominal_;
  FlightProfile profile_;
  Deterioration deterioration_;
  FanSpeedDemand fan_speed_;
  ControlledEngine engine_;
  SensorSuite sensors_;
  std::vector<ScheduledFault> pending_faults_;
  std::uint64_t sequence_ = 0;
};

}  // namespace ehm::engine
