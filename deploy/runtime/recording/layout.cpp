// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/recording/layout.h"

namespace ehm::recording {

const std::array<DoubleTable, 9>& double_tables() {
  using Group = ChannelGroup;
  static const std::array<DoubleTable, 9> tables{{
      {"W", Group::flight_and_actuators, [](Row& r) { return r.w.data(); }},
      {"X_s", Group::sensors, [](Row& r) { return r.x_s.data(); }},
      {"R", Group::sensors, [](Row& r) { return r.innovation.data(); }},
      {"X_v", Group::auxiliary, [](Row& r) { return r.x_v.data(); }},
      {"X_v_sigma", Group::auxiliary, [](Row& r) { return r.x_v_sigma.data(); }},
      {"X_v_sigma_filter", Group::auxiliary, [](Row& r) { return r.x_v_sigma_filter.data(); }},
      {"T", Group::health, [](Row& r) { return r.t.data(); }},
      {"T_sigma", Group::health, [](Row& r) { return r.t_sigma.data(); }},
      {"T_sigma_filter", Group::health, [](Row& r) { return r.t_sigma_filter.data(); }},
  }};
  return tables;
}

const std::array<Channel, identity_columns>& identity_channels() {
  static const std::array<Channel, identity_columns> channels{
      {{"unit", "-"},     {"sequence", "-"},        {"source_time_ns", "ns"}, {"received_ns", "ns"},
       {"kind", "-"},     {"age_ns", "ns"},         {"schema", "-"},          {"source_id", "-"},
       {"writer", "-"},   {"sensor_valid", "bits"}, {"sensor_count", "-"},    {"actuator_count", "-"},
       {"accepted", "-"}, {"estimates", "-"},       {"flags", "bits"},        {"sensors_used", "bits"},
       {"fused", "bits"}, {"rejected", "bits"},     {"design", "-"},          {"lost_before", "-"}}};
  return channels;
}

std::vector<Channel> columns(const Channels& channels, ChannelGroup group) {
  switch (group) {
    case ChannelGroup::sensors:
      return channels.sensors;
    case ChannelGroup::auxiliary:
      return channels.auxiliary;
    case ChannelGroup::health:
      return channels.health;
    case ChannelGroup::flight_and_actuators:
      break;
  }
  std::vector<Channel> flight{{"altitude_m", "m"}, {"mach", "-"}, {"delta_isa_k", "K"}};
  flight.insert(flight.end(), channels.actuators.begin(), channels.actuators.end());
  return flight;
}

}  // namespace ehm::recording
