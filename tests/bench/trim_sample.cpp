// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/trim_sample.h"

#include <chrono>

#include "idl/wire_values.h"
#include "monitor/design/design_file.h"

namespace ehm::tuner_design {

TrimSample::TrimSample(const std::string& design_file, std::uint32_t engine_id) {
  const linear_model::LinearModel model = design::read_design(design_file).model;
  EngineSensors& s = trim_;
  s.engine_id(engine_id);
  s.schema(idl::schema_version);
  s.source_id(1);
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  s.source_time_ns(std::chrono::duration_cast<std::chrono::nanoseconds>(now).count());
  if (model.operating_point) {
    s.altitude_m(model.operating_point->altitude_m);
    s.mach(model.operating_point->mach);
    s.delta_isa_k(model.operating_point->delta_isa_k);
  }
  s.sensor_count(static_cast<std::uint32_t>(model.sensors.size()));
  s.sensor_valid((1u << model.sensors.size()) - 1u);
  for (std::size_t i = 0; i < model.sensors.size(); ++i) s.sensor()[i] = model.sensors[i].trim;
  s.actuator_count(static_cast<std::uint32_t>(model.controls.size()));
  for (std::size_t i = 0; i < model.controls.size(); ++i) s.actuator()[i] = model.controls[i].trim;
  sample_ = trim_;
}

const EngineSensors& TrimSample::next(std::int64_t period_ns) {
  const std::uint64_t sequence = sample_.sequence_number() + 1;
  sample_.sequence_number(sequence);
  sample_.source_time_ns(sample_.source_time_ns() + period_ns);
  const double moved = 1.0 + 1e-6 * static_cast<double>(sequence % 7);
  for (std::size_t i = 0; i < sample_.sensor_count(); ++i) sample_.sensor()[i] = trim_.sensor()[i] * moved;
  return sample_;
}

TrimSample TrimSample::of_engine(std::uint32_t engine_id) const {
  TrimSample other = *this;
  other.trim_.engine_id(engine_id);
  other.sample_ = other.trim_;
  return other;
}

}  // namespace ehm::tuner_design
