// SPDX-License-Identifier: Apache-2.0
#pragma once
// `engine_sim maps`: pictures of the five component maps.

#include <CLI/CLI.hpp>
#include <functional>
#include <iosfwd>

namespace ehm::engine_sim {

/// Adds the subcommand to `app`; `run` is set to its action when the user chose it.
void add_maps_command(CLI::App& app, std::function<void(std::ostream& out, std::ostream& err)>& run);

}  // namespace ehm::engine_sim
