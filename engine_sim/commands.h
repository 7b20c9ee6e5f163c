// SPDX-License-Identifier: Apache-2.0
#pragma once
// The offline commands of engine_sim: deck, engine and maps. They need no DDS and no configuration.

#include <CLI/App.hpp>
#include <functional>
#include <iosfwd>
#include <optional>

namespace ehm::engine_sim {

using Command = std::function<void(std::ostream& out, std::ostream& err)>;
/// The commands as subcommands of `app`; parsing sets `run` to the chosen one.
void add_commands(CLI::App& app, Command& run);

inline constexpr const char* command_help =
    "Commands: engine_sim deck (performance deck), engine_sim engine (engine files: export, check, show), engine_sim "
    "maps "
    "(pictures of the component maps); each with --help.";

/// Runs the command that the first argument names and returns the exit code of the program; nothing if the first
/// argument is an option or absent, which is the service's own command line.
std::optional<int> run_command(int argc, const char* const* argv, std::ostream& out, std::ostream& err);

}  // namespace ehm::engine_sim
