// SPDX-License-Identifier: Apache-2.0
#pragma once
// One simulated engine in flight: profile -> control -> gas path -> sensors, one sample after another. No clock, no
// DDS.
//
// Sample k is taken at t = k dt. The fuel flow of sample k acts from t to t + dt, and its direct effect on pressures
// and temperatures is in the readings of sample k: u[k] of theory.md, section 4.
// A demand out of reach is no error: the control's limits hold the engine. Only the start is the caller's to choose.
// @throws FlightError when the first demand or the flight leaves no running engine; the message says when, where, what
// was demanded, and which balance does not close.

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine_sim/control/controlled_engine.h"
#include "engine_sim/control/fan_speed_demand.h"
#include "engine_sim/disturbance/speed_noise.h"
#include "engine_sim/scenario/fault_schedule.h"
#include "engine_sim/scenario/flight_profile.h"
#include "engine_sim/scenario/flown_health.h"
#include "engine_sim/simulated_engine.h"

namespace ehm::engine_sim {

struct SimSample {
  std::uint64_t sequence = 0;
  double time_s = 0.0;
  FlightCondition flight;         ///< as reported
  Actuation actuation;            ///< as it is; the fuel meter's word is in `inputs`
  Operation inputs;               ///< as reported: fuel flow, vanes off their schedule, off-take
  std::vector<Reading> readings;  ///< in the order of the engine's channels
  HealthVector health{};          ///< as it acts, process noise and all
  std::vector<double> auxiliary;
};

class FlightError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Simulation : public SimulatedEngine {
 public:
  explicit Simulation(const Scenario& scenario);

  /// The next sample; the first is at t = 0 with the engine in balance.
  SimSample next();

  const EngineChannels& channels() const override { return channels_; }
  std::string start_text() const override;
  std::span<const double> mismatch() const override { return scenario_.mismatch; }
  /// The same as next(), channel by channel.
  EngineSample next_sample() override;
  double time_s() const override { return static_cast<double>(sequence_) * scenario_.sample_time_s; }
  /// New engine at the start of the flight: trim of the sensors' noise, and of the description.
  /// The engine as its file says it, without the mismatch.
  const GasPath& nominal() const { return nominal_.gas; }

  /// `demand`: n1_rpm or net_thrust_n
  void demand(const Demand& demand) override { profile_.override_demand(demand); }
  void fly(const FlightCondition& flight) override { profile_.override_flight(flight); }
  /// Moves a health parameter to `target` within ramp_s, from now on.
  void order_health(std::size_t parameter, double target, double ramp_s) override {
    flown_health_.order(health(parameter), target, ramp_s, time_s());
  }
  double most_net_thrust_n() const override;
  HealthRange health_range(std::size_t) const override { return {health_min, health_max}; }
  double health_of(std::size_t parameter) const override { return flown_health_.lasting(time_s(), health(parameter)); }
  /// Does the engine go on running for a second, if the flight condition jumps there now?
  bool can_fly(const FlightCondition& flight) const override;
  /// Does it go on running for three seconds, if a health parameter moves there within ramp_s (a second at most here)?
  bool can_wear(std::size_t parameter, double target, double ramp_s) const override;
  void inject(std::size_t sensor, const SensorFault& fault) override { sensors_.inject(sensor, fault); }

 private:
  /// Of a health channel among the gas path's.
  Health health(std::size_t channel) const { return scenario_.engine->channels.health.at(channel).parameter; }
  /// Flies a copy on for so long, under the flight condition and with the health of each moment from now.
  template <class Flight, class Health>
  bool survives(double seconds, Flight flight, Health health_at) const;
  ControlledSample step(const ProfilePoint& now, const HealthVector& health);
  Operation reported(const ProfilePoint& now, const ControlledSample& sample) const;

  Scenario scenario_;
  Turbofan filed_;  ///< as its file says: what trims and the demand of thrust refer to
  Turbofan flown_;  ///< as built
  SteadyPoint nominal_;
  FlightProfile profile_;
  FlownHealth flown_health_;
  SpeedNoise speed_noise_;
  FanSpeedDemand fan_speed_;
  ControlledEngine engine_;
  SensorSuite sensors_;
  EngineChannels channels_;
  FaultSchedule pending_faults_;
  std::uint64_t sequence_ = 0;
};

}  // namespace ehm::engine_sim
