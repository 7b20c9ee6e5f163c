// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/simulation.h"

#include <algorithm>
#include <sstream>
#include <string>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/mismatch/mismatch.h"
#include "engine_sim/simulation_channels.h"

namespace ehm::engine_sim {

namespace {

std::string describe(const FlightCondition& flight, const std::string& demand) {
  std::ostringstream text;
  text << "at " << flight.altitude_m << " m, Mach " << flight.mach << ", ISA " << std::showpos << flight.delta_isa_k
       << std::noshowpos << " K the engine cannot run with " << demand;
  return text.str();
}

/// The new engine at the demand that starts the flight, or a message for the person who made it.
SteadyPoint trimmed(const Turbofan& turbofan, const Scenario& scenario) {
  try {
    return solve_scheduled(turbofan, scenario.control, {.flight = scenario.flight, .offtake = scenario.offtake},
                           scenario.demand);
  } catch (const std::exception& e) {
    std::ostringstream text;
    text << describe(scenario.flight, std::string(demand_names[as_size(scenario.demand.kind)])) << " = "
         << scenario.demand.value << " (t40_k may be up to some " << turbofan.data().ratings.t40_max_k
         << "); change demand or flight: " << e.what();
    throw FlightError(text.str());
  }
}

/// The worn engine where the flight starts: at its demand, or at the limit that stops it.
ControlledEngine started(const Turbofan& turbofan, const Scenario& scenario, const Surroundings& surroundings,
                         double n1_rpm) {
  try {
    return {turbofan, scenario.control, settled(turbofan, scenario.control, surroundings, n1_rpm),
            scenario.heat_soak ? HeatSoak::with : HeatSoak::without,
            scenario.process_noise.on() ? Motion::restless : Motion::smooth};
  } catch (const std::exception& e) {
    std::ostringstream text;
    text << describe(surroundings.flight, "n1_rpm") << " = " << n1_rpm
         << "; change demand, flight or wear: " << e.what();
    throw FlightError(text.str());
  }
}

/// `of(i)` of each parameter.
template <class Of>
HealthVector health_by(Of of) {
  HealthVector health;
  for (std::size_t i = 0; i < health_count; ++i) health[i] = of(i);
  return health;
}

HealthVector lasting_health(const FlownHealth& flown, double time_s) {
  return health_by([&](std::size_t i) { return flown.lasting(time_s, i); });
}

}  // namespace

Simulation::Simulation(const Scenario& scenario)
    : scenario_(scenario),
      filed_(scenario.engine->data),
      flown_(built(scenario.engine->data, scenario.mismatch)),
      nominal_(trimmed(filed_, scenario)),
      profile_({.flight = scenario.flight,
                .demand = {DemandKind::n1_rpm, nominal_.gas.speeds.n1_rpm},
                .offtake = scenario.offtake},
               scenario.profile),
      flown_health_(scenario),
      speed_noise_(scenario.process_noise, static_cast<std::uint64_t>(scenario.seed)),
      fan_speed_(filed_, scenario.control),
      engine_(started(flown_, scenario,
                      {profile_.at(0.0).flight, lasting_health(flown_health_, 0.0), profile_.at(0.0).offtake},
                      fan_speed_.n1_rpm(profile_.at(0.0).demand, profile_.at(0.0).flight))),
      sensors_(scenario.engine->channels.sensors, scenario.sensors, true_sensors(*scenario.engine, nominal_.gas),
               static_cast<std::uint64_t>(scenario.seed)),
      channels_(channels_of(scenario, nominal_, sensors_)),
      pending_faults_(scenario.faults) {}

SimSample Simulation::next() {
  SimSample sample;
  sample.sequence = sequence_;
  sample.time_s = time_s();
  const ProfilePoint now = profile_.at(sample.time_s);
  flown_health_.next_sample();
  sample.health = health_by([&](std::size_t i) { return flown_health_.acting(sample.time_s, i); });
  for (const auto& [sensor, fault] : pending_faults_.due(sample.time_s)) inject(sensor, fault);

  const ControlledSample flown = step(now, sample.health);
  const GasPath& gas = flown.gas;
  sample.actuation = flown.actuation;
  sample.inputs = reported(now, flown);
  sample.flight = sample.inputs.flight;
  sample.auxiliary = true_auxiliary(*scenario_.engine, gas);
  sample.readings = sensors_.read(true_sensors(*scenario_.engine, gas), sample.time_s, scenario_.sample_time_s);
  ++sequence_;
  return sample;
}

Operation Simulation::reported(const ProfilePoint& now, const ControlledSample& sample) const {
  const ReportedInputs said = misread({now.flight, sample.actuation.fuel_flow_kg_s}, scenario_.mismatch);
  return {.flight = said.flight,
          .fuel_flow_kg_s = said.fuel_flow_kg_s,
          .geometry = sample.geometry,
          .offtake = now.offtake};
}

ControlledSample Simulation::step(const ProfilePoint& now, const HealthVector& health) {
  const double n1_rpm = fan_speed_.n1_rpm(now.demand, now.flight);
  try {
    const ControlledSample sample = engine_.step({now.flight, health, now.offtake}, n1_rpm, scenario_.sample_time_s);
    engine_.disturb(speed_noise_.next(engine_.speeds()));
    return sample;
  } catch (const std::exception& e) {
    std::ostringstream text;
    text << "after " << time_s() << " s, " << describe(now.flight, "n1_rpm") << " = " << n1_rpm
         << "; change the profile, wear or command more gently"
         << (scenario_.process_noise.on() ? ", or lessen the process noise: " : ": ") << e.what();
    throw FlightError(text.str());
  }
}

double Simulation::most_net_thrust_n() const {
  FanSpeedDemand fan_speed = fan_speed_;
  return fan_speed.most_net_thrust_n(profile_.at(time_s()).flight);
}

template <class Flight, class Health>
bool Simulation::survives(double seconds, Flight flight, Health health_at) const {
  try {
    ControlledEngine trial = engine_;
    FanSpeedDemand fan_speed = fan_speed_;
    const ProfilePoint now = profile_.at(time_s());
    const double n1_rpm = fan_speed.n1_rpm(now.demand, flight);
    for (double flown_s = 0.0; flown_s < seconds; flown_s += scenario_.sample_time_s)
      trial.step({flight, health_at(flown_s), now.offtake}, n1_rpm, scenario_.sample_time_s);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

bool Simulation::can_fly(const FlightCondition& flight) const {
  return survives(1.0, flight, [now = lasting_health(flown_health_, time_s())](double) { return now; });
}

bool Simulation::can_wear(std::size_t parameter, double target, double ramp_s) const {
  const HealthVector now = lasting_health(flown_health_, time_s());
  const Health worn = health(parameter);
  const double trial_ramp_s = std::min(ramp_s, 1.0);
  return survives(3.0, profile_.at(time_s()).flight, [&](double flown_s) {
    HealthVector h = now;
    const double share = trial_ramp_s > 0.0 ? std::min(1.0, flown_s / trial_ramp_s) : 1.0;
    h[worn] += share * (target - now[worn]);
    return h;
  });
}

}  // namespace ehm::engine_sim
