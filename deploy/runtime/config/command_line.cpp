// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/config/command_line.h"

#include <CLI/CLI.hpp>
#include <iostream>

#include "deploy/runtime/config/man_page.h"
#include "deploy/runtime/config/usage_answer.h"
#include "deploy/runtime/service/exit_code.h"

namespace ehm::config {

std::optional<int> parse_command_line(int argc, char** argv, const std::string& program, const std::string& purpose,
                                      Schema& schema, CommandLine& line, const CLI::App* commands) {
  CLI::App app{purpose, program};
  app.footer(service::exit_code_help);
  bool print_config = false;
  app.add_option("--config", line.file, "configuration file (TOML)");
  app.add_flag("--print-config", print_config, "print every key with default, range and description, and exit");
  app.add_flag("--check-config", line.check_config, "read the configuration and what it names, and exit");
  app.set_version_flag("--version", program + " " EHM_VERSION);
  if (line.more_options) line.more_options(app);
  add_man_flag(app, {&app, commands, &schema});
  schema.add_flags(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return usage_answer(app, e);
  }
  if (!print_config) return std::nullopt;
  std::cout << schema.reference();
  return service::exit_ok;
}

}  // namespace ehm::config
