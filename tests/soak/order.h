// SPDX-License-Identifier: Apache-2.0
#pragma once
// One line of the soak's script to the agent becomes one command on DDS.
//
//   sensor CHANNEL KIND MAGNITUDE DURATION_S   KIND as in idl::SensorFaultKind, by name; MAGNITUDE in its unit
//   health CHANNEL CHANGE RAMP_S               relative to the present health, fraction
//   clear                                      all sensor faults
//   reset                                      the monitor's filter
//   quit

#include <optional>
#include <string>
#include <variant>

#include "engine_health.h"

namespace ehm::soak {

struct Quit {};
using Order = std::variant<SimCommand, MonitorCommand, Quit>;

/// Nothing for a line that is none of the above.
std::optional<Order> read_order(const std::string& line, std::uint32_t engine_id);

}  // namespace ehm::soak
