// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/dds/sim_publisher.h"

#include <algorithm>

#include "idl/wire_values.h"

namespace ehm::engine_sim {

namespace {

/// @returns how many.
template <class Described>
std::uint32_t describe_all(const std::vector<EngineChannel>& channels, Described& described) {
  for (std::size_t i = 0; i < channels.size(); ++i) {
    described[i].name() = channels[i].name.c_str();
    described[i].unit() = channels[i].unit.c_str();
    described[i].trim(channels[i].trim);
    described[i].sigma(channels[i].sigma);
  }
  return static_cast<std::uint32_t>(channels.size());
}

}  // namespace

SimPublisher::SimPublisher(idl::Participant& participant, std::uint32_t engine_id, std::uint32_t source_id)
    : sensors_(participant), truth_(participant), description_(participant) {
  sensors_sample_.engine_id(engine_id);
  sensors_sample_.schema(idl::schema_version);
  sensors_sample_.source_id(source_id);
  truth_sample_.engine_id(engine_id);
  truth_sample_.schema(idl::schema_version);
  truth_sample_.source_id(source_id);
}

void SimPublisher::state_mismatch(std::span<const double> mismatch) {
  truth_sample_.mismatch_count(static_cast<std::uint32_t>(mismatch.size()));
  std::copy(mismatch.begin(), mismatch.end(), truth_sample_.mismatch().begin());
}

void SimPublisher::describe(const EngineChannels& channels) {
  EngineDescription d;
  d.engine_id(sensors_sample_.engine_id());
  d.source_id(sensors_sample_.source_id());
  d.role(static_cast<std::uint32_t>(idl::DescriptionRole::source));
  d.schema(idl::schema_version);
  d.engine_type() = channels.engine_type.c_str();
  d.sample_time_s(channels.sample_time_s);
  d.actuator_count(describe_all(channels.actuators, d.actuators()));
  d.sensor_count(describe_all(channels.sensors, d.sensors()));
  d.health_count(describe_all(channels.health, d.health()));
  d.auxiliary_count(describe_all(channels.auxiliary, d.auxiliary()));
  description_.write(d);
}

bool SimPublisher::publish(const EngineSample& sample, std::int64_t source_time_ns) {
  truth_sample_.sequence_number(sample.sequence);
  truth_sample_.source_time_ns(source_time_ns);
  truth_sample_.health_count(static_cast<std::uint32_t>(sample.health.size()));
  truth_sample_.auxiliary_count(static_cast<std::uint32_t>(sample.auxiliary.size()));
  std::copy(sample.health.begin(), sample.health.end(), truth_sample_.health().begin());
  std::copy(sample.auxiliary.begin(), sample.auxiliary.end(), truth_sample_.auxiliary().begin());
  const bool truth_sent = truth_.write(truth_sample_);

  sensors_sample_.sequence_number(sample.sequence);
  sensors_sample_.source_time_ns(source_time_ns);
  sensors_sample_.altitude_m(sample.flight.altitude_m);
  sensors_sample_.mach(sample.flight.mach);
  sensors_sample_.delta_isa_k(sample.flight.delta_isa_k);
  sensors_sample_.actuator_count(static_cast<std::uint32_t>(sample.actuators.size()));
  std::copy(sample.actuators.begin(), sample.actuators.end(), sensors_sample_.actuator().begin());
  sensors_sample_.sensor_count(static_cast<std::uint32_t>(sample.sensors.size()));
  std::uint32_t valid = 0;
  for (std::size_t i = 0; i < sample.sensors.size(); ++i) {
    sensors_sample_.sensor()[i] = sample.sensors[i].value;
    valid |= (sample.sensors[i].valid ? 1u : 0u) << i;
  }
  sensors_sample_.sensor_valid(valid);
  return sensors_.write(sensors_sample_) && truth_sent;
}

}  // namespace ehm::engine_sim
