// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/simulation_channels.h"

#include <sstream>

#include "engine_sim/simulation.h"

namespace ehm::engine_sim {
namespace {

std::vector<double> settings(const EngineDefinition& engine, Operation operation) {
  std::vector<double> values;
  for (const ControlChannel* control : engine.channels.controls) values.push_back(control->of(operation));
  return values;
}

/// A channel of the table with its trim.
template <class Listed>
EngineChannel described(const Listed& channel, double trim, double sigma = 0.0) {
  return {std::string(channel.name), std::string(channel.unit), trim, sigma};
}

}  // namespace

EngineChannels channels_of(const Scenario& scenario, const SteadyPoint& nominal, const SensorSuite& sensors) {
  const EngineDefinition& engine = *scenario.engine;
  const NamedChannels& named = engine.channels;
  EngineChannels c{engine_type(engine.data), scenario.sample_time_s, {}, {}, {}, {}};
  const auto controls = settings(engine, nominal.operation);
  const auto measured = true_sensors(engine, nominal.gas), auxiliary = true_auxiliary(engine, nominal.gas);
  for (std::size_t i = 0; i < controls.size(); ++i) c.actuators.push_back(described(*named.controls[i], controls[i]));
  for (std::size_t i = 0; i < measured.size(); ++i)
    c.sensors.push_back(described(*named.sensors[i].quantity, measured[i], sensors.noise_sigma(i)));
  for (const HealthChannel& health : named.health)
    c.health.push_back({std::string(health_names[health.parameter]), "fraction"});
  for (std::size_t i = 0; i < auxiliary.size(); ++i)
    c.auxiliary.push_back(described(*named.auxiliary[i], auxiliary[i]));
  return c;
}

EngineSample Simulation::next_sample() {
  SimSample s = next();
  std::vector<double> worn;
  for (const HealthChannel& channel : scenario_.engine->channels.health) worn.push_back(s.health[channel.parameter]);
  return {s.sequence,
          s.flight,
          settings(*scenario_.engine, s.inputs),
          std::move(s.readings),
          std::move(worn),
          std::move(s.auxiliary)};
}

std::string Simulation::start_text() const {
  std::ostringstream text;
  text << "flies at " << scenario_.flight.altitude_m << " m, Mach " << scenario_.flight.mach << ", fan speed "
       << nominal().speeds.n1_rpm << " rpm";
  return text.str();
}

}  // namespace ehm::engine_sim
