// SPDX-License-Identifier: Apache-2.0
#include "tests/soak/order.h"

#include <sstream>

#include "idl/fault_names.h"

namespace ehm::soak {

namespace {

SimCommand sim_command(std::uint32_t engine_id, idl::SimCommandKind kind) {
  SimCommand c;
  c.engine_id(engine_id);
  c.schema(idl::schema_version);
  c.kind(static_cast<std::uint32_t>(kind));
  return c;
}

std::optional<Order> sensor_order(std::istringstream& words, std::uint32_t engine_id) {
  std::uint32_t channel = 0;
  std::string kind;
  double magnitude = 0.0, duration_s = 0.0;
  if (!(words >> channel >> kind >> magnitude >> duration_s)) return {};
  const auto fault = idl::sensor_fault_kind(kind);
  if (!fault) return {};
  SimCommand c = sim_command(engine_id, idl::SimCommandKind::sensor_fault);
  c.channel(channel);
  c.fault(static_cast<std::uint32_t>(*fault));
  c.value()[0] = magnitude;
  c.value()[1] = duration_s;
  return c;
}

std::optional<Order> health_order(std::istringstream& words, std::uint32_t engine_id) {
  std::uint32_t channel = 0;
  double change = 0.0, ramp_s = 0.0;
  if (!(words >> channel >> change >> ramp_s)) return {};
  SimCommand c = sim_command(engine_id, idl::SimCommandKind::add_health);
  c.channel(channel);
  c.value()[0] = change;
  c.value()[1] = ramp_s;
  return c;
}

}  // namespace

std::optional<Order> read_order(const std::string& line, std::uint32_t engine_id) {
  std::istringstream words(line);
  std::string verb;
  words >> verb;
  if (verb == "sensor") return sensor_order(words, engine_id);
  if (verb == "health") return health_order(words, engine_id);
  if (verb == "clear") return sim_command(engine_id, idl::SimCommandKind::clear_faults);
  if (verb == "quit") return Quit{};
  if (verb != "reset") return {};
  MonitorCommand c;
  c.engine_id(engine_id);
  c.schema(idl::schema_version);
  c.kind(static_cast<std::uint32_t>(idl::MonitorCommandKind::reset));
  return c;
}

}  // namespace ehm::soak
