#pragma once
// `tuner_design linearise`: the engine at one operating point becomes a linear model file.

#include <CLI/CLI.hpp>
#include <functional>
#include <iosfwd>

namespace ehm::bench {

/// Adds the subcommand to `app`; `run` is set to its action when the user chose it.
void add_linearise_command(CLI::App& app, std::function<void(std::ostream&)>& run);

}  // namespace ehm::bench
