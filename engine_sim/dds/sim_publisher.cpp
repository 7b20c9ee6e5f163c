#include "engine_sim/dds/sim_publisher.h"

#include <algorithm>

#include "idl/layout.h"
#include "idl/wire_values.h"

namespace ehm::engine {

namespace {

constexpr std::uint32_t actuator_count = 3;  ///< fuel flow, vanes, bleed valves, as in the linear model
static_assert(sensor_count <= EHM_MAX_SENSORS && health_count <= EHM_MAX_HEALTH &&
              auxiliary_count <= EHM_MAX_AUXILIARY);

ChannelDescription channel(std::string_view name, std::string_view unit, double trim, double sigma) {
  ChannelDescription description;
  description.name() = std::string(name).c_str();
  description.unit() = std::string(unit).c_str();
  description.trim(trim);
  description.sigma(sigma);
  return description;
}

}  // namespace

SimPublisher::SimPublisher(wire::Participant& participant, const Scenario& scenario)
    : scenario_(scenario), sensors_(participant), truth_(participant), description_(participant) {
  const auto engine_id = static_cast<std::uint32_t>(scenario.engine_id);
  const auto source_id = static_cast<std::uint32_t>(scenario.source_id);
  sensors_sample_.engine_id(engine_id);
  sensors_sample_.schema(wire::schema_version);
  sensors_sample_.source_id(source_id);
  sensors_sample_.sensor_count(sensor_count);
  sensors_sample_.actuator_count(actuator_count);
  truth_sample_.engine_id(engine_id);
  truth_sample_.schema(wire::schema_version);
  truth_sample_.source_id(source_id);
  truth_sample_.health_count(health_count);
  truth_sample_.auxiliary_count(auxiliary_count);
}

void SimPublisher::describe(const Simulation& simulation) {
  const GasPath& nominal = simulation.nominal();
  EngineDescription d;
  d.engine_id(static_cast<std::uint32_t>(scenario_.engine_id));
  d.source_id(static_cast<std::uint32_t>(scenario_.source_id));
  d.role(static_cast<std::uint32_t>(wire::DescriptionRole::source));
  d.schema(wire::schema_version);
  d.engine_type() = scenario_.engine_type.c_str();
  d.sample_time_s(scenario_.sample_time_s);
  d.actuator_count(actuator_count);
  d.actuators()[0] = channel("fuel_flow", "kg/s", nominal.fuel_flow_kg_s, 0.0);
  d.actuators()[1] = channel("VSV", "deg", 0.0, 0.0);  // off its schedule
  d.actuators()[2] = channel("VBV", "fraction", simulation.nominal_geometry().vbv_fraction, 0.0);
  d.sensor_count(sensor_count);
  const auto sensors = true_sensors(nominal);
  for (std::size_t i = 0; i < sensor_count; ++i)
    d.sensors()[i] = channel(sensor_names[i].name, sensor_names[i].unit, sensors[i], simulation.noise_sigma(i));
  d.health_count(health_count);
  for (std::size_t i = 0; i < health_count; ++i) d.health()[i] = channel(health_names[i], "fraction", 0.0, 0.0);
  d.auxiliary_count(auxiliary_count);
  const auto auxiliary = true_auxiliary(nominal);
  for (std::size_t i = 0; i < auxiliary_count; ++i)
    d.auxiliary()[i] = channel(auxiliary_names[i].name, auxiliary_names[i].unit, auxiliary[i], 0.0);
  description_.write(d);
}

bool SimPublisher::publish(const SimSample& sample, std::int64_t source_time_ns) {
  truth_sample_.sequence_number(sample.sequence);
  truth_sample_.source_time_ns(source_time_ns);
  std::copy(sample.health.begin(), sample.health.end(), truth_sample_.health().begin());
  std::copy(sample.auxiliary.begin(), sample.auxiliary.end(), truth_sample_.auxiliary().begin());
  const bool truth_sent = truth_.write(truth_sample_);

  sensors_sample_.sequence_number(sample.sequence);
  sensors_sample_.source_time_ns(source_time_ns);
  sensors_sample_.altitude_m(sample.flight.altitude_m);
  sensors_sample_.mach(sample.flight.mach);
  sensors_sample_.delta_isa_k(sample.flight.delta_isa_k);
  sensors_sample_.actuator()[0] = sample.actuation.fuel_flow_kg_s;
  sensors_sample_.actuator()[1] = sample.geometry.vsv_deg;
  sensors_sample_.actuator()[2] = sample.geometry.vbv_fraction;
  std::uint32_t valid = 0;
  for (std::size_t i = 0; i < sensor_count; ++i) {
    sensors_sample_.sensor()[i] = sample.readings[i].value;
    valid |= (sample.readings[i].valid ? 1u : 0u) << i;
  }
  sensors_sample_.sensor_valid(valid);
  return sensors_.write(sensors_sample_) && truth_sent;
}

}  // namespace ehm::engine
