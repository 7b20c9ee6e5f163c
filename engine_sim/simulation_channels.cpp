#include "engine_sim/simulation_channels.h"

#include <sstream>

#include "engine_sim/simulation.h"

namespace ehm::engine_sim {

EngineChannels channels_of(const Scenario& scenario, const SteadyPoint& nominal, const SensorSuite& sensors) {
  EngineChannels c{scenario.engine_type, scenario.sample_time_s, {}, {}, {}, {}};
  c.actuators = {{"fuel_flow", "kg/s", nominal.gas.fuel_flow_kg_s},
                 {"VSV", "deg"},  // off its schedule
                 {"VBV", "fraction", nominal.operation.geometry.vbv_fraction}};
  const auto sensor_trim = true_sensors(nominal.gas);
  for (std::size_t i = 0; i < sensor_count; ++i)
    c.sensors.push_back(
        {std::string(sensor_names[i].name), std::string(sensor_names[i].unit), sensor_trim[i], sensors.noise_sigma(i)});
  for (const auto& name : health_names) c.health.push_back({std::string(name), "fraction"});
  const auto auxiliary_trim = true_auxiliary(nominal.gas);
  for (std::size_t i = 0; i < auxiliary_count; ++i)
    c.auxiliary.push_back(
        {std::string(auxiliary_names[i].name), std::string(auxiliary_names[i].unit), auxiliary_trim[i]});
  return c;
}

EngineSample Simulation::next_sample() {
  const SimSample s = next();
  return {s.sequence,
          s.flight,
          {s.actuation.fuel_flow_kg_s, s.geometry.vsv_deg, s.geometry.vbv_fraction},
          {s.readings.begin(), s.readings.end()},
          {s.health.begin(), s.health.end()},
          {s.auxiliary.begin(), s.auxiliary.end()}};
}

std::string Simulation::start_text() const {
  std::ostringstream text;
  text << "flies at " << scenario_.flight.altitude_m << " m, Mach " << scenario_.flight.mach << ", fan speed "
       << nominal().speeds.n1_rpm << " rpm";
  return text.str();
}

}  // namespace ehm::engine_sim
