// SPDX-License-Identifier: Apache-2.0
#pragma once
// monitor history ENGINE: what has been noted of an engine, flight by flight, its EGT margin and what is due; and notes
// what was done to it on the ground. Needs no DDS and no configuration.

#include <CLI/App.hpp>
#include <iosfwd>
#include <memory>
#include <optional>

namespace ehm::monitor {

inline constexpr const char* history_command_help =
    "Command: monitor history ENGINE (flights of an engine, its EGT margin, what is due), with --help.";

struct HistoryQuestion;
/// The command as a subcommand of `app`.
std::shared_ptr<HistoryQuestion> add_history_command(CLI::App& app);

/// Runs the command that the first argument names and returns the exit code of the program; nothing if the first
/// argument is an option or absent, which is the service's own command line.
std::optional<int> run_command(int argc, const char* const* argv, std::ostream& out, std::ostream& err);

}  // namespace ehm::monitor
