#include "engine_sim/simulation.h"

#include <algorithm>
#include <sstream>
#include <string>

#include "engine_sim/model/engines/jt9d.h"

namespace ehm::engine {

namespace {

std::string describe(const FlightCondition& flight, const std::string& demand) {
  std::ostringstream text;
  text << "at " << flight.altitude_m << " m, Mach " << flight.mach << ", ISA " << std::showpos << flight.delta_isa_k
       << std::noshowpos << " K the engine cannot run with " << demand;
  return text.str();
}

/// solve_steady with a message for the person who made the demand.
SteadyPoint settle(const Turbofan& turbofan, const FlightCondition& flight, const HealthVector& health,
                   const Demand& demand, const SteadyPoint* start = nullptr) {
  constexpr const char* names[]{"fuel_flow_kg_s", "n1_rpm", "net_thrust_n", "t40_k"};
  try {
    return solve_steady(turbofan, flight, health, demand, start);
  } catch (const std::exception& e) {
    std::ostringstream text;
    text << describe(flight, names[static_cast<std::size_t>(demand.kind)]) << " = " << demand.value
         << " (at cruise t40_k may be some 1000 to 1400); change demand, flight or wear: " << e.what();
    throw FlightError(text.str());
  }
}

}  // namespace

Simulation::Simulation(const Scenario& scenario)
    : scenario_(scenario),
      turbofan_(jt9d()),
      nominal_(settle(turbofan_, scenario.flight, HealthVector{}, scenario.demand)),
      profile_({0.0, scenario.flight, nominal_.gas.speeds.n1_rpm}, scenario.profile),
      deterioration_(scenario),
      start_(settle(turbofan_, profile_.at(0.0).flight, deterioration_.at(0.0),
                    {DemandKind::n1_rpm, profile_.at(0.0).n1_rpm}, &nominal_)),
      transient_(turbofan_, start_),
      governor_(scenario.governor, start_.gas.speeds.n1_rpm, start_.operation.fuel_flow_kg_s),
      sensors_(scenario.sensors, true_sensors(nominal_.gas), static_cast<std::uint64_t>(scenario.seed)),
      pending_faults_(scenario.faults) {
  std::sort(pending_faults_.begin(), pending_faults_.end(),
            [](const auto& a, const auto& b) { return a.fault.start_s > b.fault.start_s; });
}

SimSample Simulation::next() {
  SimSample sample;
  sample.sequence = sequence_;
  sample.time_s = time_s();
  const ProfilePoint now = profile_.at(sample.time_s);
  sample.flight = now.flight;
  sample.health = deterioration_.at(sample.time_s);
  sample.fuel_flow_kg_s = governor_.update(now.n1_rpm, transient_.speeds().n1_rpm, scenario_.sample_time_s);
  while (!pending_faults_.empty() && pending_faults_.back().fault.start_s <= sample.time_s) {
    sensors_.inject(pending_faults_.back().sensor, pending_faults_.back().fault);
    pending_faults_.pop_back();
  }

  const Operation operation{sample.flight, sample.health, sample.fuel_flow_kg_s};
  const GasPath gas = output(operation, sample.time_s);
  sample.auxiliary = true_auxiliary(gas);
  sample.readings = sensors_.read(gas, sample.time_s, scenario_.sample_time_s);

  transient_.step(operation, scenario_.sample_time_s);
  ++sequence_;
  return sample;
}

GasPath Simulation::output(const Operation& operation, double time_s) {
  try {
    return transient_.output(operation);
  } catch (const std::exception& e) {
    std::ostringstream text;
    text << "after " << time_s << " s, "
         << describe(operation.flight, "fuel flow " + std::to_string(operation.fuel_flow_kg_s) + " kg/s")
         << "; change the profile, wear or command more gently: " << e.what();
    throw FlightError(text.str());
  }
}

bool Simulation::can_fly(const FlightCondition& flight) const {
  try {
    solve_steady(turbofan_, flight, health(), {DemandKind::n1_rpm, profile_.at(time_s()).n1_rpm}, &start_);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace ehm::engine
