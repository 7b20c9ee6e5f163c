// SPDX-License-Identifier: Apache-2.0
#include "monitor/checks/source_fit.h"

#include <algorithm>
#include <limits>

namespace ehm::monitor {

namespace {

/// In the design's unit; NaN where it must not be used.
double converted(const ChannelFit& fit, double value) noexcept {
  if (!fit.used()) return std::numeric_limits<double>::quiet_NaN();
  return fit.conversion.changes() ? fit.conversion(value) : value;
}

}  // namespace

ChannelFit fit_channel(const ChannelWords& said, const std::vector<linear_model::Channel>& channels,
                       std::size_t i) noexcept {
  const bool same_name = said.name.empty() || said.name == channels[i].name;
  const auto has_it = [&](const linear_model::Channel& channel) { return channel.name == said.name; };
  if (!same_name && std::any_of(channels.begin(), channels.end(), has_it)) return {Misfit::place, {}};
  const auto conversion = units::conversion(said.unit, channels[i].unit);
  if (!conversion) return {Misfit::unit, {}};
  return {same_name ? Misfit::none : Misfit::name, *conversion};
}

void SourceFit::apply(Sample& sample) const noexcept {
  const std::size_t sent = std::min<std::size_t>(sample.sensor_count, sensors.size());
  for (std::size_t i = 0; i < sent; ++i) {
    sample.sensor[i] = converted(sensors[i], sample.sensor[i]);
    if (!sensors[i].used()) sample.sensor_valid &= ~(1u << i);
  }
  const std::size_t acting = std::min<std::size_t>(sample.actuator_count, actuators.size());
  for (std::size_t i = 0; i < acting; ++i) sample.actuator[i] = converted(actuators[i], sample.actuator[i]);
}

}  // namespace ehm::monitor
