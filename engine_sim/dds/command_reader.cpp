#include "engine_sim/dds/command_reader.h"

#include <cmath>
#include <stdexcept>

#include "deploy/config/table_reader.h"
#include "idl/wire_values.h"

namespace ehm::engine {

namespace {

using wire::SimCommandKind;

void require(const char* field, double value, double min, double max) {
  if (!(value >= min && value <= max))
    throw std::invalid_argument(std::string(field) + " is " + config::number_text(value) + ", allowed is " +
                                config::number_text(min) + " to " + config::number_text(max));
}

void change_health(const SimCommand& c, SimulatedEngine& s, bool relative) {
  require("channel", c.channel(), 0, static_cast<double>(s.channels().health.size()) - 1);
  require("value[1] (ramp_s)", c.value()[1], 0, 1e9);
  const double present = s.health_of(c.channel());
  const double target = relative ? present + c.value()[0] : c.value()[0];
  const HealthRange range = s.health_range(c.channel());
  require("health after the command", target, range.least, range.most);
  if (!s.can_wear(c.channel(), target, c.value()[1]))
    throw std::invalid_argument("the engine does not survive a health of " + config::number_text(target) +
                                " at its present power; change the demand first, or by less");
  s.order_health(c.channel(), target, c.value()[1]);
}

void inject_fault(const SimCommand& c, SimulatedEngine& s) {
  require("channel", c.channel(), 0, static_cast<double>(s.channels().sensors.size()) - 1);
  require("fault", c.fault(), 0, static_cast<double>(wire::SensorFaultKind::noise));
  require("value[0] (magnitude)", c.value()[0], -1e9, 1e9);
  require("value[1] (duration_s)", c.value()[1], 0, 1e9);
  s.inject(c.channel(), {static_cast<FaultKind>(c.fault()), c.value()[0], s.time_s(), c.value()[1]});
}

}  // namespace

void apply(const SimCommand& c, SimulatedEngine& s) {
  require("schema", c.schema(), wire::schema_version, wire::schema_version);
  switch (static_cast<SimCommandKind>(c.kind())) {
    case SimCommandKind::set_demand:
      require("value[0] (n1_rpm)", c.value()[0], 500, 5000);
      return s.demand({DemandKind::n1_rpm, c.value()[0]});
    case SimCommandKind::set_thrust:
      require("value[0] (net_thrust_n)", c.value()[0], 0, 1e6);
      return s.demand({DemandKind::net_thrust_n, c.value()[0]});
    case SimCommandKind::set_flight:
      require("value[0] (altitude_m)", c.value()[0], -500, 15000);
      require("value[1] (mach)", c.value()[1], 0, 0.95);
      require("value[2] (delta_isa_k)", c.value()[2], -60, 60);
      if (const FlightCondition flight{c.value()[0], c.value()[1], c.value()[2]}; s.can_fly(flight))
        return s.fly(flight);
      throw std::invalid_argument(
          "the engine does not survive the jump from its present power; change the demand first, or in steps");
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
  throw std::invalid_argument("kind is " + std::to_string(c.kind()) + ", allowed is 1 to 7 (idl/wire_values.h)");
}

void CommandReader::apply_all(SimulatedEngine& simulation, const std::function<void(const std::string&)>& say) {
  SimCommand command;
  while (reader_.take(command)) {
    if (command.engine_id() != engine_id_) continue;
    try {
      apply(command, simulation);
      say("command " + std::to_string(command.kind()) + " applied at " + config::number_text(simulation.time_s()) +
          " s");
    } catch (const std::invalid_argument& e) {
      say(std::string("command refused: ") + e.what());
    }
  }
}

}  // namespace ehm::engine
