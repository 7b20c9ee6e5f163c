// SPDX-License-Identifier: Apache-2.0
#include "monitor/dds/source_descriptions.h"

#include <algorithm>
#include <cstring>

#include "idl/wire_values.h"

namespace ehm::monitor {

namespace {

constexpr std::int64_t longest_wait_ns = 50'000'000;
constexpr std::size_t most_sources = 16'384;  // so that nobody fills the memory with made-up ones

template <std::size_t Size, class Text>
void copy_text(const Text& from, std::array<char, Size>& to) noexcept {
  const std::size_t length = std::min(std::strlen(from.c_str()), Size - 1);
  std::copy_n(from.c_str(), length, to.begin());
  to[length] = '\0';
}

template <class Wire, class Channels>
std::uint32_t copy_channels(const Wire& from, std::uint32_t count, Channels& to) noexcept {
  const std::size_t kept = std::min<std::size_t>(count, to.size());
  for (std::size_t i = 0; i < kept; ++i) {
    copy_text(from[i].name(), to[i].name);
    copy_text(from[i].unit(), to[i].unit);
  }
  return static_cast<std::uint32_t>(kept);
}

}  // namespace

std::size_t DescribedSource::sensors_of(const linear_model::LinearModel& m) const noexcept {
  return std::min<std::size_t>(sensor_count, m.sensors.size());
}

std::size_t DescribedSource::actuators_of(const linear_model::LinearModel& m) const noexcept {
  return std::min<std::size_t>(actuator_count, m.controls.size());
}

bool DescribedSource::other_engine(const linear_model::LinearModel& m) const noexcept {
  const std::string_view said = engine_type.words().name;
  return !said.empty() && !m.engine_type.empty() && said != m.engine_type;
}

void DescribedSource::fit_to(const linear_model::LinearModel& m) noexcept {
  model = &m;
  fit = {};
  for (std::size_t i = 0; i < sensors_of(m); ++i) fit.sensors[i] = fit_channel(sensors[i].words(), m.sensors, i);
  for (std::size_t i = 0; i < actuators_of(m); ++i) fit.actuators[i] = fit_channel(actuators[i].words(), m.controls, i);
}

DescribedSource* SourceDescriptions::place(const SourceKey& key) {
  const auto known = sources_.find(key);
  if (known != sources_.end()) return &known->second;
  return sources_.size() < most_sources ? &sources_[key] : nullptr;
}

DescribedSource* SourceDescriptions::keep(const EngineDescription& d) {
  if (d.role() != static_cast<std::uint32_t>(idl::DescriptionRole::source) || d.schema() != idl::schema_version)
    return nullptr;
  DescribedSource* source = place({d.engine_id(), d.source_id(), reader_.participant()});
  if (!source) return nullptr;
  source->sensor_count = copy_channels(d.sensors(), d.sensor_count(), source->sensors);
  source->actuator_count = copy_channels(d.actuators(), d.actuator_count(), source->actuators);
  copy_text(d.engine_type(), source->engine_type.name);
  source->described = true;
  source->model = nullptr;
  return source;
}

DescribedSource* SourceDescriptions::find(const SourceKey& key) noexcept {
  const auto found = sources_.find(key);
  return found != sources_.end() && found->second.described ? &found->second : nullptr;
}

bool SourceDescriptions::awaited(const SourceKey& key, std::int64_t since_ns, std::int64_t now_ns) {
  const auto known = sources_.find(key);
  if (known != sources_.end() && (known->second.described || known->second.waited_for)) return false;
  if (!reader_.hears(key.participant)) return false;
  if (now_ns - since_ns < longest_wait_ns) return true;
  if (DescribedSource* source = place(key)) source->waited_for = true;
  return false;
}

void SourceDescriptions::forget_models() noexcept {
  for (auto& [key, source] : sources_) source.model = nullptr;
}

}  // namespace ehm::monitor
