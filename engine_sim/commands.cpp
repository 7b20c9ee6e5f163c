// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/commands.h"

#include <CLI/CLI.hpp>
#include <ostream>
#include <string>

#include "deploy/runtime/config/usage_answer.h"
#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/service/exit_code.h"
#include "engine_sim/deck/deck_command.h"
#include "engine_sim/engine_command/engine_command.h"
#include "engine_sim/figures/maps_command.h"

namespace ehm::engine_sim {

void add_commands(CLI::App& app, Command& run) {
  add_deck_command(app, run);
  add_engine_command(app, run);
  add_maps_command(app, run);
}

std::optional<int> run_command(int argc, const char* const* argv, std::ostream& out, std::ostream& err) {
  const std::string command = argc > 1 ? argv[1] : "-";
  if (command.starts_with('-')) return std::nullopt;
  if (command != "deck" && command != "engine" && command != "maps") {
    err << config::unknown_command("engine_sim", command, {"deck", "engine", "maps"}, "the service's options");
    return service::exit_usage;
  }
  Command run;
  CLI::App app("The truth of the engine health monitor.", "engine_sim");
  app.require_subcommand(1);
  app.footer(service::exit_code_help);
  add_commands(app, run);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return config::usage_answer(app, error, out, err);
  }
  try {
    run(out, err);
    return service::exit_ok;
  } catch (const files::FileError& error) {
    err << "engine_sim " << command << ": " << error.what() << '\n';
    return service::exit_usage;
  } catch (const std::exception& error) {
    err << "engine_sim " << command << ": " << error.what() << '\n';
    return service::exit_failed;
  }
}

}  // namespace ehm::engine_sim
