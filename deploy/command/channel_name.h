// SPDX-License-Identifier: Apache-2.0
#pragma once
// The channel that the operator means, among those that the running engine describes.

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>

#include "deploy/command/order.h"
#include "idl/command_text.h"

namespace ehm::operating {

class UnknownChannel : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Index of the channel of that name, or of the only one that differs from it in capitals alone.
/// @throws UnknownChannel that lists the names there are; `kind` says what they are, as "sensor"
std::size_t find_channel(const std::string& name, std::span<const ChannelDescription> channels,
                         const std::string& kind);

/// Gives the order's command its engine and the number of its channel; returns the channel as it is described. An order
/// without a channel needs no description, and gets an empty one back.
/// @throws UnknownChannel, also where those who describe the engine number the channel differently: one order cannot
///         mean both
idl::OrderedChannel address(Order& order, std::uint32_t engine_id, std::span<const EngineDescription> descriptions);

}  // namespace ehm::operating
