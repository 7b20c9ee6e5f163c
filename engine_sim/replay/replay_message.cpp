// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/replay/replay_message.h"

#include <algorithm>

#include "idl/wire_values.h"

namespace ehm::engine_sim {

static_assert(recording::max_sensors == EHM_MAX_SENSORS && recording::max_actuators == EHM_MAX_ACTUATORS);

EngineSensors message_of(const recording::Row& row, const recording::Channels& channels, std::int64_t shift_ns) {
  EngineSensors message;
  message.engine_id(static_cast<std::uint32_t>(row.a.unit));
  message.schema(static_cast<std::uint32_t>(row.a.schema));
  message.sequence_number(static_cast<std::uint64_t>(row.a.sequence));
  message.source_time_ns(row.a.source_time_ns + shift_ns);
  message.altitude_m(row.w[0]);
  message.mach(row.w[1]);
  message.delta_isa_k(row.w[2]);
  message.source_id(static_cast<std::uint32_t>(row.a.source_id));
  message.sensor_valid(static_cast<std::uint32_t>(row.a.sensor_valid));
  message.sensor_count(static_cast<std::uint32_t>(row.a.sensor_count));
  message.actuator_count(static_cast<std::uint32_t>(row.a.actuator_count));
  std::copy_n(row.w.begin() + recording::flight_channels, channels.actuators.size(), message.actuator().begin());
  std::copy_n(row.x_s.begin(), channels.sensors.size(), message.sensor().begin());
  return message;
}

EngineDescription description_of(std::uint32_t engine_id, std::uint32_t source_id, const recording::FileInfo& info) {
  EngineDescription d;
  d.engine_id(engine_id);
  d.source_id(source_id);
  d.role(static_cast<std::uint32_t>(idl::DescriptionRole::source));
  d.schema(idl::schema_version);
  d.sample_time_s(info.sample_time_s);
  const auto describe = [](const std::vector<recording::Channel>& from, auto& to) {
    for (std::size_t i = 0; i < from.size(); ++i) {
      to[i].name() = from[i].name.c_str();
      to[i].unit() = from[i].unit.c_str();
    }
    return static_cast<std::uint32_t>(from.size());
  };
  d.actuator_count(describe(info.channels.actuators, d.actuators()));
  d.sensor_count(describe(info.channels.sensors, d.sensors()));
  return d;
}

}  // namespace ehm::engine_sim
