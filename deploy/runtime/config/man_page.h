// SPDX-License-Identifier: Apache-2.0
#pragma once
// A program's manual page, written from what its command line and its configuration schema already say: no text stands
// twice. Sections: NAME, SYNOPSIS, DESCRIPTION, OPTIONS, COMMANDS (each with its own options), CONFIGURATION (every key
// with default, allowed values, flag and environment variable), EXIT STATUS, FILES, SEE ALSO.
// The output is roff with the man macros, as `man -l` reads it.

#include <CLI/App.hpp>
#include <string>

#include "deploy/runtime/config/schema.h"

namespace ehm::config {

struct ManPage {
  const CLI::App* app = nullptr;       ///< name, description, options, subcommands; the exit codes are its footer
  const CLI::App* commands = nullptr;  ///< whose subcommands are the program's commands, if another
  const Schema* schema = nullptr;      ///< of a service: its page is in section 8, of a tool in section 1
};

std::string man_page(const ManPage& page);

/// --man: prints the page and ends the program as --version does. What `page` points at must outlive the parsing.
void add_man_flag(CLI::App& app, const ManPage& page);

}  // namespace ehm::config
