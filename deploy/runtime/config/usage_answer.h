// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a program answers to a command line that it does not take: one line with its own name, what is wrong, what may
// have been meant, and where the help is.
//
//   engine_sim: unknown option --run-duraton-s; did you mean --run-duration-s? See engine_sim --help

#include <CLI/App.hpp>
#include <iosfwd>
#include <string>
#include <vector>

namespace ehm::config {

/// Answers what `app` has thrown while it parsed: --help and the like on `out`, an error on `err`. Returns 0 or 2, the
/// exit code. The first word that nobody knows comes before all other errors, such as the option that it should be.
int usage_answer(const CLI::App& app, const CLI::ParseError& error, std::ostream& out, std::ostream& err);
/// The same on standard output and standard error.
int usage_answer(const CLI::App& app, const CLI::ParseError& error);

/// The line for a first word that is no command; `besides` is what else the program would take.
std::string unknown_command(const std::string& program, const std::string& word,
                            const std::vector<std::string>& commands, const std::string& besides = "");

}  // namespace ehm::config
