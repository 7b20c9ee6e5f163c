// SPDX-License-Identifier: Apache-2.0
// engine_sim: arguments -> scenario -> simulated engine -> DDS, one sample each period -> exit code;
// engine_sim COMMAND: an offline command instead (commands.h).

#include <spdlog/spdlog.h>

#include <iostream>
#include <memory>
#include <string>

#include "deploy/runtime/config/command_line.h"
#include "deploy/runtime/config/schema.h"
#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/service/exit_code.h"
#include "deploy/runtime/service/ignored_signals.h"
#include "deploy/runtime/service/log.h"
#include "deploy/runtime/service/stop_deadline.h"
#include "deploy/runtime/service/stop_signal.h"
#include "deploy/runtime/service/written.h"
#include "engine_sim/commands.h"
#include "engine_sim/linear/linear_engine.h"
#include "engine_sim/replay/replay.h"
#include "engine_sim/replay/unflown_keys.h"
#include "engine_sim/run.h"
#include "engine_sim/scenario/scenario_file.h"
#include "engine_sim/simulation.h"
#include "idl/dds/descriptors.h"
#include "idl/dds/security.h"

namespace {

using namespace ehm;

/// The turbofan, or the user's own model. @throws std::runtime_error naming the keys that are wrong.
std::unique_ptr<engine_sim::SimulatedEngine> make_engine(const engine_sim::SimConfig& config) {
  try {
    if (config.linear) return std::make_unique<engine_sim::LinearEngine>(*config.linear, config.scenario);
    return std::make_unique<engine_sim::Simulation>(config.scenario);
  } catch (const std::exception& e) {
    throw std::runtime_error(
        (config.linear ? "'linear.model': " + config.linear_file + ": " : "'demand', 'flight' or 'wear': ") + e.what());
  }
}

/// A recording instead of a flight: the same exit codes.
int replay(const engine_sim::SimConfig& config, const std::vector<std::string>& given, bool check_only) {
  if (const std::string unflown = engine_sim::unflown_keys(given); !unflown.empty())
    spdlog::warn("a replay flies nothing: it does not use {}; leave out what only a flight needs", unflown);
  try {
    const auto rows = recording::open_rows(config.replay.file, config.replay.column_map);
    if (check_only) {
      std::cout << "configuration is valid; " << config.replay.file << " can be replayed\n";
      return service::exit_ok;
    }
    const service::StopSignal stop;
    const service::StopDeadline deadline;
    engine_sim::run_replay(config, *rows, stop);
    service::StopDeadline::in_order();
    return service::exit_ok;
  } catch (const files::FileError& e) {
    std::cerr << "engine_sim: " << e.what() << '\n';
    return service::exit_usage;
  } catch (const config::ConfigError& e) {
    std::cerr << "engine_sim: " << e.what() << '\n';
    return service::exit_usage;
  } catch (const std::exception& e) {
    std::cerr << "engine_sim: " << e.what() << '\n';
    return service::exit_failed;
  }
}

int run(int argc, char** argv) {
  if (const auto code = engine_sim::run_command(argc, argv, std::cout, std::cerr)) return *code;
  service::ignore_fatal_signals();
  service::start_log("engine_sim");

  engine_sim::SimConfig config;
  config::Schema schema;
  engine_sim::declare(schema, config);

  config::CommandLine line;
  const std::string purpose =
      std::string("Flies a nonlinear turbofan, or a linear model of your own, and publishes its sensors on DDS.\n") +
      engine_sim::command_help;
  CLI::App commands;
  engine_sim::Command run_none;
  engine_sim::add_commands(commands, run_none);
  if (const auto code = config::parse_command_line(argc, argv, "engine_sim", purpose, schema, line, &commands))
    return *code;

  try {
    schema.load(line.file);
    engine_sim::finish_config(config, schema);
    idl::check_security(config.security);
    idl::require_descriptors();
    spdlog::set_level(spdlog::level::from_str(config.log_level));
  } catch (const std::exception& e) {
    std::cerr << "engine_sim: " << e.what() << '\n';
    return service::exit_usage;
  }

  if (!config.replay.file.empty()) return replay(config, schema.given(), line.check_config);
  std::unique_ptr<engine_sim::SimulatedEngine> simulated;
  try {
    simulated = make_engine(config);
  } catch (const std::exception& e) {
    std::cerr << "engine_sim: " << e.what() << '\n';
    return service::exit_usage;
  }
  if (line.check_config) {
    std::cout << "configuration is valid; the engine " << simulated->start_text() << '\n';
    return service::exit_ok;
  }

  try {
    const service::StopSignal stop;
    const service::StopDeadline deadline;
    engine_sim::run(config, *simulated, stop);
    service::StopDeadline::in_order();
    return service::exit_ok;
  } catch (const std::exception& e) {
    std::cerr << "engine_sim: " << e.what() << '\n';
    return service::exit_failed;
  }
}

}  // namespace

int main(int argc, char** argv) {
  return ehm::service::written(run(argc, argv), std::cout, std::cerr, "engine_sim");
}
