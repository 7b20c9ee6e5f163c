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

wire::OrderedChannel address(Order& order, std::uint32_t engine_id, const EngineDescription& description) {
  std::visit([&](auto& command) { command.engine_id(engine_id); }, order.command);
  if (order.channel_kind == ChannelKind::none) return {};
  const bool sensor = order.channel_kind == ChannelKind::sensor;
  const std::span<const ChannelDescription> channels =
      sensor ? std::span(description.sensors()).first(description.sensor_count())
             : std::span(description.health()).first(description.health_count());
  const std::size_t i = find_channel(order.channel, channels, sensor ? "sensor" : "health parameter");
  std::get<SimCommand>(order.command).channel(static_cast<std::uint32_t>(i));
  return {channels[i].name().c_str(), channels[i].unit().c_str()};
}

}  // namespace ehm::operating
