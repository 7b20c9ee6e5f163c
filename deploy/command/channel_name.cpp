// SPDX-License-Identifier: Apache-2.0
#include "deploy/command/channel_name.h"

#include <fmt/format.h>
#include <strings.h>

#include <optional>

namespace ehm::operating {

namespace {

std::string list_of(std::span<const ChannelDescription> channels) {
  std::string list;
  for (const auto& channel : channels) list += (list.empty() ? "" : ", ") + std::string(channel.name().c_str());
  return list.empty() ? "none" : list;
}

}  // namespace

std::size_t find_channel(const std::string& name, std::span<const ChannelDescription> channels,
                         const std::string& kind) {
  std::optional<std::size_t> alike;
  std::size_t count = 0;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const std::string described = channels[i].name().c_str();
    if (described == name) return i;
    if (strcasecmp(described.c_str(), name.c_str()) != 0) continue;
    alike = i;
    ++count;
  }
  if (count == 1) return *alike;
  throw UnknownChannel(fmt::format("the engine has {} {} '{}'; there are {}", count == 0 ? "no" : "more than one", kind,
                                   name, list_of(channels)));
}

idl::OrderedChannel address(Order& order, std::uint32_t engine_id, std::span<const EngineDescription> descriptions) {
  std::visit([&](auto& command) { command.engine_id(engine_id); }, order.command);
  if (order.channel_kind == ChannelKind::none) return {};
  const bool sensor = order.channel_kind == ChannelKind::sensor;
  std::optional<std::size_t> number;
  idl::OrderedChannel channel;
  for (const auto& d : descriptions) {
    const std::span<const ChannelDescription> channels =
        sensor ? std::span(d.sensors()).first(d.sensor_count()) : std::span(d.health()).first(d.health_count());
    const std::size_t i = find_channel(order.channel, channels, sensor ? "sensor" : "health parameter");
    if (number.value_or(i) != i)
      throw UnknownChannel(fmt::format("the simulators of engine {} number '{}' differently; stop one of them",
                                       engine_id, order.channel));
    number = i;
    channel = {channels[i].name().c_str(), channels[i].unit().c_str()};
  }
  std::get<SimCommand>(order.command).channel(static_cast<std::uint32_t>(number.value()));
  return channel;
}

}  // namespace ehm::operating
