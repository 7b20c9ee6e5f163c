// SPDX-License-Identifier: Apache-2.0
#include "deploy/command/order.h"

#include <memory>
#include <optional>

#include "deploy/client/number_check.h"
#include "idl/fault_names.h"
#include "idl/wire_names.h"

namespace ehm::operating {

namespace {

using client::finite_number;
using idl::SensorFaultKind;
using idl::SimCommandKind;

SimCommand sim_command(SimCommandKind kind, double first = 0.0, double second = 0.0, double third = 0.0) {
  SimCommand command;
  command.schema(idl::schema_version);
  command.kind(static_cast<std::uint32_t>(kind));
  command.value() = {first, second, third, 0.0};
  return command;
}

void add_fault(CLI::App& app, Order& order) {
  struct Arguments {
    std::string sensor, kind;
    std::optional<double> magnitude;
    double duration_s = 0.0;
  };
  const auto a = std::make_shared<Arguments>();
  CLI::App* fault = app.add_subcommand("fault", "Breaks a sensor of the simulated engine");
  fault->add_option("sensor", a->sensor, "sensor, by the name in the engine's description")->required();
  fault
      ->add_option(
          "kind", a->kind,
          "bias (magnitude: offset in the sensor's unit), drift (unit per second), noise (factor on it), stuck, "
          "dropout")
      ->required()
      ->check(CLI::IsMember({"bias", "drift", "stuck", "dropout", "noise"}));
  fault->add_option("magnitude", a->magnitude, "of a bias, a drift or noise")->check(finite_number());
  fault->add_option("--duration,--duration-s", a->duration_s, "seconds of the flight; 0: until cleared")
      ->check(finite_number(0.0))
      ->capture_default_str();
  fault->callback([a, &order] {
    const SensorFaultKind kind = *idl::sensor_fault_kind(a->kind);
    const bool sized = kind != SensorFaultKind::stuck && kind != SensorFaultKind::dropout;
    if (sized && !a->magnitude) throw CLI::RequiredError("magnitude of " + a->kind);
    if (!sized && a->magnitude) throw CLI::ValidationError("magnitude", a->kind + " has none");
    SimCommand command = sim_command(SimCommandKind::sensor_fault, a->magnitude.value_or(0.0), a->duration_s);
    command.fault(static_cast<std::uint32_t>(kind));
    order = {command, ChannelKind::sensor, a->sensor};
  });
}

void add_health(CLI::App& app, Order& order) {
  struct Arguments {
    std::string parameter;
    double value = 0.0, ramp_s = 0.0;
    bool add = false;
  };
  const auto a = std::make_shared<Arguments>();
  CLI::App* health = app.add_subcommand("health", "Wears or mends a component of the simulated engine");
  health->add_option("parameter", a->parameter, "health parameter, by the name in the engine's description")
      ->required();
  health->add_option("value", a->value, "fraction of nominal: -0.02 is 2 % lost")->required()->check(finite_number());
  health->add_option("--ramp,--ramp-s", a->ramp_s, "seconds of the flight that it takes; 0: at once")
      ->check(finite_number(0.0))
      ->capture_default_str();
  health->add_flag("--add", a->add, "the value is added to the present one");
  health->callback([a, &order] {
    const auto kind = a->add ? SimCommandKind::add_health : SimCommandKind::set_health;
    order = {sim_command(kind, a->value, a->ramp_s), ChannelKind::health, a->parameter};
  });
}

void add_flight(CLI::App& app, Order& order) {
  struct Arguments {
    double altitude_m = 0.0, mach = 0.0, delta_isa_k = 0.0;
  };
  const auto a = std::make_shared<Arguments>();
  CLI::App* flight = app.add_subcommand("flight", "Moves the simulated engine to another flight condition");
  flight->add_option("--altitude-m,--altitude", a->altitude_m, "pressure altitude, m")
      ->required()
      ->check(finite_number());
  flight->add_option("--mach", a->mach, "flight Mach number")->required()->check(finite_number());
  flight->add_option("--delta-isa-k,--delta-isa", a->delta_isa_k, "ambient temperature above standard, K")
      ->check(finite_number())
      ->capture_default_str();
  flight->callback(
      [a, &order] { order = {sim_command(SimCommandKind::set_flight, a->altitude_m, a->mach, a->delta_isa_k)}; });
}

void add_demand(CLI::App& app, Order& order) {
  struct Arguments {
    std::optional<double> n1_rpm, net_thrust_n;
  };
  const auto a = std::make_shared<Arguments>();
  CLI::App* demand = app.add_subcommand("demand", "Demands another power of the simulated engine");
  demand->add_option("--n1-rpm", a->n1_rpm, "fan speed, rpm; or")->check(finite_number());
  demand->add_option("--thrust-n,--net-thrust-n", a->net_thrust_n, "net thrust that the new engine would give, N")
      ->check(finite_number());
  demand->require_option(1);
  demand->callback([a, &order] {
    order = {a->n1_rpm ? sim_command(SimCommandKind::set_demand, *a->n1_rpm)
                       : sim_command(SimCommandKind::set_thrust, *a->net_thrust_n)};
  });
}

void add_clear(CLI::App& app, Order& order) {
  const auto sensor = std::make_shared<std::string>();
  CLI::App* clear = app.add_subcommand("clear", "Ends the faults of the simulated sensors");
  clear->add_option("sensor", *sensor, "of this one only");
  clear->callback([sensor, &order] {
    if (sensor->empty())
      order = {sim_command(SimCommandKind::clear_faults)};
    else
      order = {sim_command(SimCommandKind::sensor_fault), ChannelKind::sensor, *sensor};  // SensorFaultKind::none
  });
}

MonitorCommand monitor_command(std::uint32_t kind) {
  MonitorCommand command;
  command.schema(idl::schema_version);
  command.kind(kind);
  return command;
}

void add_reset(CLI::App& app, Order& order) {
  CLI::App* reset = app.add_subcommand("reset", "Starts the monitors' filters anew; --engine 0: of all engines");
  reset->callback([&order] { order = {monitor_command(static_cast<std::uint32_t>(idl::MonitorCommandKind::reset))}; });
}

void add_publish(CLI::App& app, Order& order) {
  const auto name = std::make_shared<std::string>();
  CLI::App* publish = app.add_subcommand(
      "publish",
      "Chooses the estimator whose estimates the monitors publish, among those that fly; --engine 0: for all engines");
  publish->add_option("estimator", *name, "tuner, the configured one, or one of estimator.shadow")
      ->required()
      ->check(CLI::IsMember(std::vector<std::string>(idl::estimator_names.begin(), idl::estimator_names.end())));
  publish->callback([name, &order] {
    const auto first = static_cast<std::uint32_t>(idl::MonitorCommandKind::publish);
    order = {monitor_command(first + static_cast<std::uint32_t>(idl::estimator_number(*name)))};
  });
}

}  // namespace

void add_orders(CLI::App& app, Order& order) {
  add_fault(app, order);
  add_health(app, order);
  add_flight(app, order);
  add_demand(app, order);
  add_clear(app, order);
  add_reset(app, order);
  add_publish(app, order);
  app.require_subcommand(1);
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) command->fallthrough();
}

}  // namespace ehm::operating
