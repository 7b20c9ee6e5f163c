// SPDX-License-Identifier: Apache-2.0
#pragma once
// `engine_sim engine export | check | show`: engine files.

#include <CLI/CLI.hpp>
#include <functional>
#include <iosfwd>

namespace ehm::engine_sim {

/// Adds the subcommand with its own three to `app`; `run` is set to the action that the user chose.
void add_engine_command(CLI::App& app, std::function<void(std::ostream& out, std::ostream& err)>& run);

}  // namespace ehm::engine_sim
