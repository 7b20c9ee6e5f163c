// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/linearise_command.h"

#include <algorithm>
#include <iomanip>
#include <memory>
#include <optional>
#include <ostream>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/model_file.h"
#include "tuner_design/cli/engine_option.h"
#include "tuner_design/linearise/linearise.h"

namespace ehm::tuner_design {
namespace {

struct Arguments {
  std::string out;
  engine_sim::FlightCondition flight{10668.0, 0.8, 0.0};
  std::optional<double> n1_rpm, net_thrust_n, t40_k, fuel_flow_kg_s;
  std::vector<std::string> health;
  bool step_study = false, heat_soak = false;
  engine_sim::SensorOverrides sensors;
  EngineOption engine;
  std::string method = "tangent", states_method, controls_method,
              health_method;  ///< the last three: empty as the first
  double perturbation_percent = 100.0 * ColumnSteps{}.relative;
  BlockMethods blocks;
  int fleet = LineariseOptions{}.fleet;
  std::uint64_t seed = LineariseOptions{}.seed;
  OutputOptions output;
};

engine_sim::Demand demand_of(const Arguments& arguments) {
  if (arguments.n1_rpm) return {engine_sim::DemandKind::n1_rpm, *arguments.n1_rpm};
  if (arguments.net_thrust_n) return {engine_sim::DemandKind::net_thrust_n, *arguments.net_thrust_n};
  if (arguments.fuel_flow_kg_s) return {engine_sim::DemandKind::fuel_flow_kg_s, *arguments.fuel_flow_kg_s};
  return {engine_sim::DemandKind::t40_k, arguments.t40_k.value_or(cruise_t40_k)};
}

/// Position of the health parameter in "name=value"; its value goes to `value`.
/// @throws CLI::ValidationError if the text has another form or the name is unknown.
std::size_t parse_health(const std::string& text, double& value) {
  const auto equals = text.find('=');
  const std::string name = text.substr(0, equals);
  const auto& names = engine_sim::health_names;
  const auto found = std::find(names.begin(), names.end(), name);
  if (equals == std::string::npos || found == names.end() ||
      !CLI::detail::lexical_cast(text.substr(equals + 1), value)) {
    std::string known;
    for (const auto& known_name : names) known += (known.empty() ? "" : ", ") + std::string(known_name);
    throw CLI::ValidationError("--health", "'" + text + "' is not name=fraction with a name of: " + known);
  }
  return as_size(found - names.begin());
}

/// In the order of ColumnMethod.
constexpr const char* column_methods[] = {"perturbation", "linmod", "steady-state"};

std::optional<ColumnMethod> column_method(const std::string& name) {
  const auto found = std::find(std::begin(column_methods), std::end(column_methods), name);
  if (found == std::end(column_methods)) return std::nullopt;
  return static_cast<ColumnMethod>(found - std::begin(column_methods));
}

/// @throws CLI::ValidationError if a block has a method of its own beside the fit over the fleet
BlockMethods block_methods(const Arguments& arguments) {
  const auto of = [&](const char* option, const std::string& own) {
    if (!own.empty() && arguments.method == "fleet")
      throw CLI::ValidationError(option, "does not go with --method fleet, which fits all columns at once");
    return column_method(own.empty() ? arguments.method : own);
  };
  BlockMethods blocks = arguments.blocks;
  blocks.states = of("--states-method", arguments.states_method);
  blocks.controls = of("--controls-method", arguments.controls_method);
  blocks.health = of("--health-method", arguments.health_method);
  blocks.steps.relative = -arguments.perturbation_percent / 100.0;  // downwards, as wear goes
  return blocks;
}

/// "tangent", or "states perturbation, controls linmod, health steady-state" where they differ.
std::string method_text(const Arguments& arguments) {
  const auto own = [&](const std::string& name) { return name.empty() ? arguments.method : name; };
  const std::string states = own(arguments.states_method), controls = own(arguments.controls_method),
                    health = own(arguments.health_method);
  if (states == controls && controls == health) return states;
  return "states " + states + ", controls " + controls + ", health " + health;
}

nlohmann::ordered_json as_json(const Linearisation& result, const Arguments& arguments) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const StepStudyRow& row : result.study.rows)
    rows.push_back({{"relative_step", row.step}, {"largest_relative_change", row.change}});
  return {{"name", result.model.name},
          {"method", method_text(arguments)},
          {"file", arguments.out},
          {"relative_step", result.study.step},
          {"step_study", std::move(rows)}};
}

void print_linearisation(const Linearisation& result, const Arguments& arguments, std::ostream& out) {
  if (arguments.step_study) {
    out << "  relative step    largest relative change of a column to the next smaller step\n";
    for (const StepStudyRow& row : result.study.rows) {
      out << std::scientific << std::setprecision(3) << std::setw(15) << row.step << std::setw(14) << row.change
          << (row.step == result.study.step ? "   chosen" : "") << '\n';
    }
    out << std::defaultfloat << std::setprecision(6);
  }
  out << result.model.name << ", " << method_text(arguments) << ": linear model written to " << arguments.out << '\n';
}

void linearise_to_file(const Arguments& arguments, const Console& console) {
  LineariseOptions options;
  options.flight = arguments.flight;
  options.demand = demand_of(arguments);
  options.method = arguments.method == "fleet" ? LineariseMethod::fleet : LineariseMethod::tangent;
  options.blocks = block_methods(arguments);
  options.fleet = arguments.fleet;
  options.seed = arguments.seed;
  options.heat_soak = arguments.heat_soak;
  options.sensors = arguments.sensors;
  for (const std::string& text : arguments.health) {
    double value = 0.0;
    const std::size_t index = parse_health(text, value);
    options.health[index] = value;
  }
  const Linearisation result = linearise(arguments.engine.engine(), options);
  linear_model::write_model(result.model, arguments.out);
  print_result(
      console, arguments.output, [&] { return as_json(result, arguments); },
      [&](std::ostream& out) { print_linearisation(result, arguments, out); });
}

void add_method_options(CLI::App& command, Arguments& arguments) {
  command
      .add_option(
          "--method", arguments.method,
          "tangent: derivatives at the trim engine at the step where they settle; perturbation: differences at "
          "--perturbation; linmod: at the tiny step of Matlab's linmod; steady-state: response of the states and "
          "open-loop steady states; fleet: best fit over engines with the fleet's spread")
      ->check(CLI::IsMember({"tangent", "perturbation", "linmod", "steady-state", "fleet"}))
      ->capture_default_str();
  const auto block = [&](const char* name, std::string& method, const char* columns) {
    command.add_option(name, method, std::string("Method of the columns of the ") + columns + "; default: --method")
        ->check(CLI::IsMember({"tangent", "perturbation", "linmod", "steady-state"}));
  };
  block("--states-method", arguments.states_method, "states");
  block("--controls-method", arguments.controls_method, "controls");
  block("--health-method", arguments.health_method, "health parameters");
  command
      .add_option("--perturbation", arguments.perturbation_percent,
                  "perturbation, steady-state: step in percent of each input's size, downwards where it may be less")
      ->check(CLI::Range(1e-4, 5.0))
      ->capture_default_str();
  command.add_flag("--central", arguments.blocks.steps.central, "perturbation: differences to both sides");
  command
      .add_option("--response-s", arguments.blocks.steps.response_s,
                  "steady-state: seconds after which the response to a step of a state is taken")
      ->check(CLI::Range(1e-3, 1.0))
      ->capture_default_str();
}

}  // namespace

void add_linearise_command(CLI::App& app, Action& run) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("linearise", "Linear model of the nonlinear engine at one operating point");
  command->add_option("--out", arguments->out, "Linear model file to write")->required()->type_name("M.json");
  add_engine_option(*command, arguments->engine, "Engine to linearise");
  command->add_option("--altitude-m", arguments->flight.altitude_m, "Pressure altitude, m")->capture_default_str();
  command->add_option("--mach", arguments->flight.mach, "Flight Mach number")->capture_default_str();
  command->add_option("--delta-isa-k", arguments->flight.delta_isa_k, "Temperature above standard, K")
      ->capture_default_str();
  CLI::Option_group* demand = command->add_option_group("demand", "At most one; default: --t40-k 1308.6 (cruise)");
  demand->add_option("--n1-rpm", arguments->n1_rpm, "Fan speed, rpm");
  demand->add_option("--net-thrust-n", arguments->net_thrust_n, "Net thrust, N");
  demand->add_option("--t40-k", arguments->t40_k, "Burner exit temperature, K");
  demand->add_option("--fuel-flow-kg-s", arguments->fuel_flow_kg_s, "Fuel flow, kg/s");
  demand->require_option(0, 1);
  command->add_option("--health", arguments->health, "Health at trim, name=fraction (hpc_efficiency=-0.02); repeatable")
      ->type_name("NAME=VALUE")
      ->check([](const std::string& text) {
        double ignored = 0.0;
        parse_health(text, ignored);
        return std::string();
      });
  add_method_options(*command, *arguments);
  command->add_option("--fleet", arguments->fleet, "Engines of the fleet that measure the linearisation error, 0: none")
      ->check(CLI::Range(0, 1000000))
      ->capture_default_str();
  add_seed_option(*command, arguments->seed, "Of that fleet");
  command->add_flag("--heat-soak", arguments->heat_soak, "Metal temperatures behind HPC, HPT and LPT as states");
  const auto lag = [&](const char* name, std::optional<double>& tau_s, const char* kind) {
    command
        ->add_option(name, tau_s,
                     std::string("Time constant of the ") + kind +
                         " sensors as states, s; 0: none; default: what the engine file says (jt9d: none)")
        ->check(CLI::Range(0.0, 100.0));
  };
  lag("--lag-speed-s", arguments->sensors.lag_speed_s, "speed");
  lag("--lag-pressure-s", arguments->sensors.lag_pressure_s, "pressure");
  lag("--lag-temperature-s", arguments->sensors.lag_temperature_s, "temperature");
  command->add_flag("--step-study", arguments->step_study, "Print how the derivatives depend on the step");
  add_output_options(*command, arguments->output);
  command->callback(
      [arguments, &run] { run = [arguments](const Console& console) { linearise_to_file(*arguments, console); }; });
}

}  // namespace ehm::tuner_design
