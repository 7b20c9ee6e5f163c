// SPDX-License-Identifier: Apache-2.0
#include "monitor/record/record_row.h"

#include <algorithm>

#include "deploy/runtime/numbers/index.h"

namespace ehm::monitor {

using recording::Row;

static_assert(recording::max_sensors == estimation::max_sensors && recording::max_health == estimation::max_health &&
              recording::max_auxiliary == estimation::max_auxiliary &&
              recording::max_actuators == estimation::max_actuators);

namespace {

std::int64_t bits(const estimation::SensorMask& mask) noexcept {
  return static_cast<std::int64_t>(mask.to_ulong());
}

template <class Vector, class Array>
void copy(const Vector& from, Array& to) noexcept {
  std::copy(from.data(), from.data() + from.size(), to.begin());
}

void fill_sample(const Sample& sample, Row& row) noexcept {
  row.a.sequence = static_cast<std::int64_t>(sample.sequence);
  row.a.source_time_ns = sample.source_time_ns;
  row.a.schema = sample.schema;
  row.a.source_id = sample.source_id;
  row.a.writer = static_cast<std::int64_t>(sample.writer);
  row.a.sensor_valid = sample.sensor_valid;
  row.a.sensor_count = sample.sensor_count;
  row.a.actuator_count = sample.actuator_count;
  row.w[0] = sample.flight.altitude_m;
  row.w[1] = sample.flight.mach;
  row.w[2] = sample.flight.delta_isa_k;
  std::copy(sample.actuator.begin(), sample.actuator.end(), row.w.begin() + recording::flight_channels);
  row.x_s = sample.sensor;
}

void fill_estimate(const estimation::Estimate& estimate, Row& row) noexcept {
  copy(estimate.auxiliary, row.x_v);
  copy(estimate.auxiliary_sigma, row.x_v_sigma);
  copy(estimate.auxiliary_sigma_filter, row.x_v_sigma_filter);
  copy(estimate.health, row.t);
  copy(estimate.health_sigma, row.t_sigma);
  copy(estimate.health_sigma_filter, row.t_sigma_filter);
}

void fill_result(const CycleResult& result, Row& row) noexcept {
  row.a.estimates = result.estimates ? 1 : 0;
  row.a.flags = result.flags;
  row.a.sensors_used = bits(result.estimate.sensors);
  row.a.fused = bits(result.fused);
  row.a.rejected = bits(result.rejected);
  copy(result.innovation, row.innovation);
  if (!result.estimates) return;
  fill_estimate(result.estimate, row);
}

std::vector<recording::Channel> described(const std::vector<linear_model::Channel>& channels) {
  std::vector<recording::Channel> all;
  for (const auto& channel : channels) all.push_back({channel.name, channel.unit});
  return all;
}

}  // namespace

void fill_row(const EngineSlot& slot, bool accepted, Row& row) noexcept {
  row = Row{};
  row.a.unit = slot.engine_id;
  row.a.accepted = accepted ? 1 : 0;
  fill_sample(slot.sample, row);
  if (accepted) fill_result(slot.cycle.result(), row);
}

void fill_shadow(const EngineSlot& slot, int shadow, Row& row) noexcept {
  fill_marker(slot, recording::RowKind::shadow, 0, row);
  row.a.kind += slot.shadow_place[as_size(shadow)];
  const CycleResult& result = slot.cycle.result();
  const estimation::Estimate& estimate = result.shadow[as_size(shadow)];
  row.a.accepted = 1;
  row.a.estimates = result.estimates && estimate.holds ? 1 : 0;
  row.a.flags = result.flags;
  row.a.sensors_used = bits(estimate.sensors);
  if (row.a.estimates != 0) fill_estimate(estimate, row);
}

void fill_marker(const EngineSlot& slot, recording::RowKind kind, std::int64_t value, Row& row) noexcept {
  row = Row{};
  row.a.unit = slot.engine_id;
  row.a.kind = static_cast<std::int64_t>(kind);
  row.a.age_ns = value;
  row.a.sequence = static_cast<std::int64_t>(slot.sample.sequence);
  row.a.source_time_ns = slot.sample.source_time_ns;
}

void sample_of(const Row& row, Sample& sample) noexcept {
  sample.schema = static_cast<std::uint32_t>(row.a.schema);
  sample.source_id = static_cast<std::uint32_t>(row.a.source_id);
  sample.writer = static_cast<std::uint64_t>(row.a.writer);
  sample.sequence = static_cast<std::uint64_t>(row.a.sequence);
  sample.source_time_ns = row.a.source_time_ns;
  sample.flight = {row.w[0], row.w[1], row.w[2]};
  sample.sensor_valid = static_cast<std::uint32_t>(row.a.sensor_valid);
  sample.sensor_count = static_cast<std::uint32_t>(row.a.sensor_count);
  sample.actuator_count = static_cast<std::uint32_t>(row.a.actuator_count);
  std::copy(row.w.begin() + recording::flight_channels, row.w.end(), sample.actuator.begin());
  sample.sensor = row.x_s;
}

recording::Channels recorded_channels(const design::Design& design) {
  const auto& model = design.model;
  return {described(model.controls), described(model.sensors), described(model.auxiliary), described(model.health)};
}

}  // namespace ehm::monitor
