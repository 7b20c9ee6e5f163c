// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/command.h"

#include <unistd.h>

#include <filesystem>
#include <ostream>

#include "deploy/runtime/files/file_error.h"

namespace ehm::tuner_design {

void add_output_options(CLI::App& command, OutputOptions& options) {
  auto* json = command.add_flag("--json", options.json, "Print one JSON object instead of tables");
  auto* progress = command.add_flag("--progress", options.progress, "Show a progress bar also off a terminal");
  auto* quiet = command.add_flag("--quiet", options.quiet, "Print nothing but errors");
  quiet->excludes(json);
  quiet->excludes(progress);
}

void add_seed_option(CLI::App& command, std::uint64_t& seed, const std::string& description) {
  command.add_option("--seed", seed, description)->capture_default_str()->check([](const std::string& text) {
    std::uint64_t value = 0;
    const bool good = text.find('-') == std::string::npos && CLI::detail::lexical_cast(text, value);
    return good ? std::string() : "'" + text + "' is not a whole number from 0 to 18446744073709551615";
  });
}

void require_other_file(const std::string& option, const std::string& out, const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    std::error_code absent;
    const bool same =
        std::filesystem::weakly_canonical(out, absent) == std::filesystem::weakly_canonical(input, absent);
    if (same || std::filesystem::equivalent(out, input, absent))
      throw files::FileError(out + ": " + option + " is the input itself; name another file");
  }
}

long_work::ProgressBar progress_bar(const Console& console, const OutputOptions& options, std::size_t total) {
  const bool wanted = options.progress || isatty(STDERR_FILENO) == 1;
  return {console.err, wanted && !options.quiet, total};
}

void print_result(const Console& console, const OutputOptions& options,
                  const std::function<nlohmann::ordered_json()>& as_json,
                  const std::function<void(std::ostream&)>& as_table) {
  if (options.quiet) return;
  if (options.json) {
    console.out << as_json().dump(2) << '\n';
  } else {
    as_table(console.out);
  }
}

}  // namespace ehm::tuner_design
