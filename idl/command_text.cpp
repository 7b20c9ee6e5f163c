// SPDX-License-Identifier: Apache-2.0
#include "idl/command_text.h"

#include <fmt/format.h>

#include "idl/wire_names.h"

namespace ehm::idl {

namespace {

std::string fault_text(const SimCommand& c, const OrderedChannel& channel) {
  const double magnitude = c.value()[0], duration_s = c.value()[1];
  std::string what;
  switch (static_cast<SensorFaultKind>(c.fault())) {
    case SensorFaultKind::none:
      return channel.name + ": no fault";
    case SensorFaultKind::bias:
      what = fmt::format("bias of {:+} {}", magnitude, channel.unit);
      break;
    case SensorFaultKind::drift:
      what = fmt::format("drift of {:+} {}/s", magnitude, channel.unit);
      break;
    case SensorFaultKind::stuck:
      what = "stuck at its last value";
      break;
    case SensorFaultKind::dropout:
      what = "dropout";
      break;
    case SensorFaultKind::noise:
      what = fmt::format("noise times {}", magnitude);
      break;
    default:
      what = fmt::format("fault {}", c.fault());
  }
  return channel.name + ": " + what + (duration_s > 0.0 ? fmt::format(" for {} s", duration_s) : " until cleared");
}

std::string health_text(const SimCommand& c, const OrderedChannel& channel, const char* how) {
  const double ramp_s = c.value()[1];
  return fmt::format("{} {} {:+} ({}) {}", channel.name, how, c.value()[0], channel.unit,
                     ramp_s > 0.0 ? fmt::format("within {} s", ramp_s) : "at once");
}

}  // namespace

std::string order_text(const SimCommand& c, const OrderedChannel& channel) {
  switch (static_cast<SimCommandKind>(c.kind())) {
    case SimCommandKind::set_demand:
      return fmt::format("fan speed demand {} rpm", c.value()[0]);
    case SimCommandKind::set_thrust:
      return fmt::format("net thrust demand {} N", c.value()[0]);
    case SimCommandKind::set_flight:
      return fmt::format("flight at {} m, Mach {}, ISA {:+} K", c.value()[0], c.value()[1], c.value()[2]);
    case SimCommandKind::set_health:
      return health_text(c, channel, "to");
    case SimCommandKind::add_health:
      return health_text(c, channel, "by");
    case SimCommandKind::sensor_fault:
      return fault_text(c, channel);
    case SimCommandKind::clear_faults:
      return "no fault of any sensor";
  }
  return fmt::format("order of kind {}", c.kind());
}

std::string order_text(const MonitorCommand& c, const OrderedChannel&) {
  if (const std::string_view estimator = ordered_estimator(c.kind()); !estimator.empty())
    return fmt::format("estimates of {} for {}", estimator, c.engine_id() == 0 ? "all engines" : "the engine");
  if (c.kind() != static_cast<std::uint32_t>(MonitorCommandKind::reset))
    return fmt::format("order of kind {}", c.kind());
  return c.engine_id() == 0 ? "reset of the filters of all engines" : "reset of the filter";
}

}  // namespace ehm::idl
