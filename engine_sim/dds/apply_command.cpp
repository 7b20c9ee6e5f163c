// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/dds/apply_command.h"

#include <spdlog/fmt/fmt.h>

#include <stdexcept>
#include <string>

#include "idl/command_text.h"
#include "idl/wire_values.h"

namespace ehm::engine_sim {

namespace {

using idl::SimCommandKind;

class Refusal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// NaN is out of every range.
void require(const std::string& field, double value, double min, double max) {
  if (!(value >= min && value <= max))
    throw Refusal(fmt::format("{} is {}, allowed is {} to {}", field, value, min, max));
}

void set_thrust(const SimCommand& c, SimulatedEngine& s) {
  const double net_thrust_n = c.value()[0];
  require("value[0] (net_thrust_n)", net_thrust_n, 0, 1e6);
  if (const double most_n = s.most_net_thrust_n(); net_thrust_n > most_n)
    throw Refusal(
        fmt::format("value[0] (net_thrust_n) is {}, but at its limit of fan speed the engine gives {:.0f} here",
                    net_thrust_n, most_n));
  s.demand({DemandKind::net_thrust_n, net_thrust_n});
}

void set_flight(const SimCommand& c, SimulatedEngine& s) {
  require("value[0] (altitude_m)", c.value()[0], -500, 15000);
  require("value[1] (mach)", c.value()[1], 0, 0.95);
  require("value[2] (delta_isa_k)", c.value()[2], -60, 60);
  const FlightCondition flight{c.value()[0], c.value()[1], c.value()[2]};
  if (!s.can_fly(flight))
    throw Refusal("the engine does not survive the jump from its present power; change the demand first, or in steps");
  s.fly(flight);
}

void change_health(const SimCommand& c, SimulatedEngine& s, bool relative) {
  const auto& parameters = s.channels().health;
  require("channel (health parameter)", c.channel(), 0, static_cast<double>(parameters.size()) - 1);
  require("value[1] (ramp_s)", c.value()[1], 0, 1e9);
  const double target = relative ? s.health_of(c.channel()) + c.value()[0] : c.value()[0];
  const std::string& name = parameters[c.channel()].name;
  const HealthRange range = s.health_range(c.channel());
  require(name + " after the command", target, range.least, range.most);
  if (!s.can_wear(c.channel(), target, c.value()[1]))
    throw Refusal(
        fmt::format("the engine does not survive {} of {} at its present power; change the demand first, or "
                    "by less",
                    name, target));
  s.order_health(c.channel(), target, c.value()[1]);
}

void inject_fault(const SimCommand& c, SimulatedEngine& s) {
  require("channel (sensor)", c.channel(), 0, static_cast<double>(s.channels().sensors.size()) - 1);
  require("fault", c.fault(), 0, static_cast<double>(idl::SensorFaultKind::noise));
  const auto kind = static_cast<FaultKind>(c.fault());
  require("value[0] (magnitude)", c.value()[0], kind == FaultKind::noise ? 0 : -1e9, 1e9);
  require("value[1] (duration_s)", c.value()[1], 0, 1e9);
  s.inject(c.channel(), {kind, c.value()[0], s.time_s(), c.value()[1]});
}

void carry_out(const SimCommand& c, SimulatedEngine& s) {
  require("schema", c.schema(), idl::schema_version, idl::schema_version);
  switch (static_cast<SimCommandKind>(c.kind())) {
    case SimCommandKind::set_demand:
      require("value[0] (n1_rpm)", c.value()[0], 500, 30000);  // of any engine; the control holds this one's limit
      return s.demand({DemandKind::n1_rpm, c.value()[0]});
    case SimCommandKind::set_thrust:
      return set_thrust(c, s);
    case SimCommandKind::set_flight:
      return set_flight(c, s);
    case SimCommandKind::set_health:
      return change_health(c, s, false);
    case SimCommandKind::add_health:
      return change_health(c, s, true);
    case SimCommandKind::sensor_fault:
      return inject_fault(c, s);
    case SimCommandKind::clear_faults:
      for (std::size_t i = 0; i < s.channels().sensors.size(); ++i) s.inject(i, {});
      return;
  }
  throw Refusal(fmt::format("kind is {}, allowed is 1 to 7 (idl/wire_values.h)", c.kind()));
}

/// The channel of a command that was carried out.
idl::OrderedChannel channel_of(const SimCommand& c, const EngineChannels& channels) {
  const EngineChannel* channel = nullptr;
  switch (static_cast<SimCommandKind>(c.kind())) {
    case SimCommandKind::set_health:
    case SimCommandKind::add_health:
      channel = &channels.health[c.channel()];
      break;
    case SimCommandKind::sensor_fault:
      channel = &channels.sensors[c.channel()];
      break;
    default:
      return {};
  }
  return {channel->name, channel->unit};
}

}  // namespace

CommandReply apply(const SimCommand& command, SimulatedEngine& engine) {
  CommandReply reply;
  reply.engine_id(command.engine_id());
  reply.role(static_cast<std::uint32_t>(idl::DescriptionRole::source));
  reply.schema(idl::schema_version);
  reply.request(command.request());
  reply.kind(command.kind());
  std::string text;
  try {
    carry_out(command, engine);
    reply.accepted(1);
    text = fmt::format("{}, from {:.3f} s of the flight on",
                       idl::order_text(command, channel_of(command, engine.channels())), engine.time_s());
  } catch (const std::exception& e) {  // also of the model: no command ends the flight
    text = e.what();
  }
  reply.message() = text.c_str();
  return reply;
}

}  // namespace ehm::engine_sim
