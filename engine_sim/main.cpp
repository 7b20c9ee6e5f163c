// engine_sim: arguments -> scenario -> simulation -> DDS, one sample each period -> exit code.

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <iostream>
#include <optional>

#include "deploy/config/schema.h"
#include "deploy/service/exit_code.h"
#include "deploy/service/stop_signal.h"
#include "engine_sim/run.h"
#include "engine_sim/scenario/scenario_file.h"

int main(int argc, char** argv) {
  using namespace ehm;
  spdlog::set_default_logger(spdlog::stderr_color_mt("engine_sim"));

  engine::SimConfig config;
  config::Schema schema;
  engine::declare(schema, config);

  CLI::App app{"Flies a nonlinear turbofan and publishes its sensors on DDS.\n" + std::string(service::exit_code_help)};
  std::string file;
  bool print_config = false, check_config = false;
  app.add_option("--config", file, "scenario file (TOML)");
  app.add_flag("--print-config", print_config, "print every key with default, range and description, and exit");
  app.add_flag("--check-config", check_config, "read the configuration, trim the engine, and exit");
  app.set_version_flag("--version", std::string("engine_sim " EHM_VERSION));
  schema.add_flags(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? service::exit_ok : service::exit_usage;
  }
  if (print_config) {
    std::cout << schema.reference();
    return service::exit_ok;
  }

  try {
    schema.load(file);
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
  if (check_config) {
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
