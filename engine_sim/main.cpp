// engine_sim: arguments -> scenario -> simulation -> DDS, one sample each period -> exit code;
// engine_sim COMMAND: an offline command instead (commands.h).

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <iostream>
#include <optional>
#include <string>

#include "deploy/config/command_line.h"
#include "deploy/config/schema.h"
#include "deploy/service/exit_code.h"
#include "deploy/service/stop_signal.h"
#include "engine_sim/commands.h"
#include "engine_sim/run.h"
#include "engine_sim/scenario/scenario_file.h"

int main(int argc, char** argv) {
  using namespace ehm;
  if (const auto code = engine::run_command(argc, argv, std::cout, std::cerr)) return *code;
  spdlog::set_default_logger(spdlog::stderr_color_mt("engine_sim"));

  engine::SimConfig config;
  config::Schema schema;
  engine::declare(schema, config);

  config::CommandLine line;
  const std::string purpose =
      std::string("Flies a nonlinear turbofan and publishes its sensors on DDS.\n") + engine::command_help;
  CLI::App commands;
  engine::Command run_none;
  engine::add_commands(commands, run_none);
  if (const auto code = config::parse_command_line(argc, argv, "engine_sim", purpose, schema, line, &commands))
    return *code;

  try {
    schema.load(line.file);
    engine::finish_config(config);
    spdlog::set_level(spdlog::level::from_str(config.log_level));
  } catch (const std::exception& e) {
    std::cerr << "engine_sim: " << e.what() << '\n';
    return service::exit_usage;
  }

  std::optional<engine::Simulation> simulation;
  try {
    simulation.emplace(config.scenario);
  } catch (const std::exception& e) {
    std::cerr << "engine_sim: 'demand', 'flight' or 'wear': " << e.what() << '\n';
    return service::exit_usage;
  }
  if (line.check_config) {
    std::cout << "configuration is valid; fan speed demand " << simulation->nominal().speeds.n1_rpm << " rpm\n";
    return service::exit_ok;
  }

  try {
    const service::StopSignal stop;
    engine::run(config, *simulation, stop);
    return service::exit_ok;
  } catch (const std::exception& e) {
    std::cerr << "engine_sim: " << e.what() << '\n';
    return service::exit_failed;
  }
}
