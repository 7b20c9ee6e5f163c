// SPDX-License-Identifier: Apache-2.0
#pragma once
// The command line that every service has: --config, --print-config, --check-config, --help, --man, --version, and one
// flag a key of its schema.

#include <functional>
#include <optional>
#include <string>

#include "deploy/runtime/config/schema.h"

namespace ehm::config {

struct CommandLine {
  std::string file;                             ///< of --config; empty: none
  bool check_config = false;                    ///< read everything, start nothing
  std::function<void(CLI::App&)> more_options;  ///< adds what only this program has; may be empty
};

/// Parses and answers what needs no configuration. Returns the exit code if the program is to end with that.
/// `commands`: the subcommands that the program answers elsewhere, for its manual page.
std::optional<int> parse_command_line(int argc, char** argv, const std::string& program, const std::string& purpose,
                                      Schema& schema, CommandLine& line, const CLI::App* commands = nullptr);

}  // namespace ehm::config
