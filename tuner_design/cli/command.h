// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the subcommands of tuner_design share: where they write, and the options that every one of them has.
//   --json       one JSON object on the standard output instead of tables, with the same numbers
//   --progress   a bar on the standard error even where that is no terminal; on a terminal it comes by itself after 2 s
//   --quiet      neither tables nor a bar: only the files that were asked for, and errors

#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "deploy/runtime/long_work/progress_bar.h"

namespace ehm::tuner_design {

struct Console {
  std::ostream& out;
  std::ostream& err;
};

/// What the chosen subcommand does, after the command line was parsed. Throws files::FileError for what the
/// user can mend in a file (exit code 2), any other exception for exit code 1.
using Action = std::function<void(const Console&)>;

struct OutputOptions {
  bool json = false, progress = false, quiet = false;
};

void add_output_options(CLI::App& command, OutputOptions& options);

/// --seed, 0 or above: CLI11 by itself turns -1 into the largest number.
void add_seed_option(CLI::App& command, std::uint64_t& seed, const std::string& description);

/// @throws files::FileError if `out` is one of the inputs: it would be overwritten.
void require_other_file(const std::string& option, const std::string& out, const std::vector<std::string>& inputs);

/// A bar of `total` steps on the standard error, as the options ask for it.
long_work::ProgressBar progress_bar(const Console& console, const OutputOptions& options, std::size_t total);

/// The JSON object or the table, or neither, as the options ask for it.
void print_result(const Console& console, const OutputOptions& options,
                  const std::function<nlohmann::ordered_json()>& as_json,
                  const std::function<void(std::ostream&)>& as_table);

}  // namespace ehm::tuner_design
