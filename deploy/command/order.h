// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the operator's command line orders, before anybody is asked: the command as it goes over the wire but for the
// number of its channel, which only the running engine's description knows.

#include <CLI/App.hpp>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "engine_health.h"

namespace ehm::operating {

enum class ChannelKind { none, sensor, health };

struct Order {
  std::variant<SimCommand, MonitorCommand> command;
  ChannelKind channel_kind = ChannelKind::none;
  std::string channel = {};
};

/// The subcommands fault, health, flight, demand, clear, reset, publish; parsing one of them fills `order`. Numbers have
/// to be finite; which are allowed is the simulator's to say. What does not fit together is a CLI::ParseError.
void add_orders(CLI::App& app, Order& order);

}  // namespace ehm::operating
