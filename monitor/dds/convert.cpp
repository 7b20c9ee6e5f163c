// SPDX-License-Identifier: Apache-2.0
#include "monitor/dds/convert.h"

#include <algorithm>

#include "deploy/runtime/numbers/index.h"
#include "idl/wire_values.h"

namespace ehm::monitor {

static_assert(estimation::max_sensors == EHM_MAX_SENSORS && estimation::max_health == EHM_MAX_HEALTH &&
              estimation::max_auxiliary == EHM_MAX_AUXILIARY && estimation::max_actuators == EHM_MAX_ACTUATORS &&
              estimation::max_tuners <= EHM_MAX_SENSORS);

namespace {

std::uint32_t bits(const estimation::SensorMask& mask) noexcept {
  return static_cast<std::uint32_t>(mask.to_ulong());
}

template <class Vector, class Array>
void copy(const Vector& from, Array& to) noexcept {
  to.fill(0.0);
  std::copy(from.data(), from.data() + from.size(), to.begin());
}

template <class Wire>
void stamp_with(Wire& wire, const Stamp& stamp) noexcept {
  wire.engine_id(stamp.engine_id);
  wire.schema(idl::schema_version);
  wire.sequence_number(stamp.sequence);
  wire.source_time_ns(stamp.source_time_ns);
  wire.source_id(stamp.source_id);
}

ChannelDescription channel(const linear_model::Channel& from, double sigma) {
  ChannelDescription to;
  to.name() = from.name.c_str();
  to.unit() = from.unit.c_str();
  to.trim(from.trim);
  to.sigma(sigma);
  return to;
}

}  // namespace

void convert(const EngineSensors& wire, Sample& sample) noexcept {
  sample.schema = wire.schema();
  sample.source_id = wire.source_id();
  sample.sequence = wire.sequence_number();
  sample.source_time_ns = wire.source_time_ns();
  sample.flight = {wire.altitude_m(), wire.mach(), wire.delta_isa_k()};
  sample.sensor_valid = wire.sensor_valid();
  sample.sensor_count = wire.sensor_count();
  sample.actuator_count = wire.actuator_count();
  std::copy(wire.actuator().begin(), wire.actuator().end(), sample.actuator.begin());
  std::copy(wire.sensor().begin(), wire.sensor().end(), sample.sensor.begin());
}

void convert(const estimation::Estimate& estimate, std::uint32_t flags, const Stamp& stamp,
             EngineHealth& wire) noexcept {
  stamp_with(wire, stamp);
  wire.publish_time_ns(stamp.publish_time_ns);
  wire.sensors_used(bits(estimate.sensors));
  wire.flags(flags);
  wire.health_count(static_cast<std::uint32_t>(estimate.health.size()));
  wire.tuner_count(static_cast<std::uint32_t>(estimate.tuners.size()));
  copy(estimate.health, wire.health());
  copy(estimate.health_sigma, wire.sigma_total());
  copy(estimate.health_sigma_filter, wire.sigma_filter());
  copy(estimate.tuners, wire.tuner());
}

void convert(const estimation::Estimate& estimate, std::uint32_t flags, const Stamp& stamp,
             EngineAuxiliary& wire) noexcept {
  stamp_with(wire, stamp);
  wire.publish_time_ns(stamp.publish_time_ns);
  wire.sensors_used(bits(estimate.sensors));
  wire.flags(flags);
  wire.auxiliary_count(static_cast<std::uint32_t>(estimate.auxiliary.size()));
  copy(estimate.auxiliary, wire.auxiliary());
  copy(estimate.auxiliary_sigma, wire.sigma_total());
  copy(estimate.auxiliary_sigma_filter, wire.sigma_filter());
}

void convert(const CycleResult& result, const Stamp& stamp, EngineResiduals& wire) noexcept {
  stamp_with(wire, stamp);
  wire.sensor_count(static_cast<std::uint32_t>(result.innovation.size()));
  wire.rejected(bits(result.rejected));
  wire.fused(bits(result.fused));
  copy(result.innovation, wire.innovation());
  copy(result.innovation_variance, wire.innovation_variance());
  copy(result.ratio, wire.test_ratio());
  std::copy(result.reason.begin(), result.reason.end(), wire.reason().begin());
}

EngineDescription describe(const design::Design& design, std::uint32_t engine_id, std::uint32_t source_id) {
  const auto& model = design.model;
  EngineDescription d;
  d.engine_id(engine_id);
  d.source_id(source_id);
  d.role(static_cast<std::uint32_t>(idl::DescriptionRole::monitor));
  d.schema(idl::schema_version);
  d.engine_type() = model.engine_type.c_str();
  d.design_hash() = design.hash.c_str();
  d.sample_time_s(model.sample_time_s);
  d.actuator_count(static_cast<std::uint32_t>(model.controls.size()));
  for (std::size_t i = 0; i < model.controls.size(); ++i) d.actuators()[i] = channel(model.controls[i], 0.0);
  d.sensor_count(static_cast<std::uint32_t>(model.sensors.size()));
  for (std::size_t i = 0; i < model.sensors.size(); ++i)
    d.sensors()[i] = channel(model.sensors[i], model.sensor_noise_sigma(as_index(i)));
  d.health_count(static_cast<std::uint32_t>(model.health.size()));
  for (std::size_t i = 0; i < model.health.size(); ++i)
    d.health()[i] = channel(model.health[i], model.health_sigma(as_index(i)));
  d.auxiliary_count(static_cast<std::uint32_t>(model.auxiliary.size()));
  for (std::size_t i = 0; i < model.auxiliary.size(); ++i) d.auxiliary()[i] = channel(model.auxiliary[i], 0.0);
  return d;
}

}  // namespace ehm::monitor
