// SPDX-License-Identifier: Apache-2.0
#pragma once
// An order in words, the same for who gives it and who answers it: "T48: bias of +10 K for 5 s".

#include <string>

#include "engine_health.h"

namespace ehm::idl {

/// What the description topic says of the channel that an order is about.
struct OrderedChannel {
  std::string name, unit;
};

/// Numbers as short as they read back. `channel` counts for faults and health only.
std::string order_text(const SimCommand& command, const OrderedChannel& channel);
std::string order_text(const MonitorCommand& command, const OrderedChannel& none = {});

}  // namespace ehm::idl
