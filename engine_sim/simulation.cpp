#include "engine_sim/simulation.h"

#include <algorithm>

#include "engine_sim/model/engines/jt9d.h"

namespace ehm::engine {

Simulation::Simulation(const Scenario& scenario)
    : scenario_(scenario),
      turbofan_(jt9d()),
      nominal_(solve_steady(turbofan_, scenario.flight, HealthVector{}, scenario.demand)),
      profile_({0.0, scenario.flight, nominal_.gas.speeds.n1_rpm}, scenario.profile),
      deterioration_(scenario),
      start_(solve_steady(turbofan_, profile_.at(0.0).flight, deterioration_.at(0.0),
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
  const GasPath gas = transient_.output(operation);
  sample.auxiliary = true_auxiliary(gas);
  sample.readings = sensors_.read(gas, sample.time_s, scenario_.sample_time_s);

  transient_.step(operation, scenario_.sample_time_s);
  ++sequence_;
  return sample;
}

}  // namespace ehm::engine
