// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/baselines_command.h"

#include <memory>
#include <ostream>

#include "deploy/runtime/files/atomic_file.h"
#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/long_work/parallel_for.h"
#include "monitor/design/design_file.h"
#include "tuner_design/print/baseline_text.h"

namespace ehm::tuner_design {
namespace {

struct Arguments {
  std::string design, csv;
  BaselineOptions options;
  OutputOptions output;
};

void compare(const Arguments& arguments, const Console& console) {
  const design::Design design = design::read_design(arguments.design);
  BaselineOptions options = arguments.options;
  options.threads = long_work::all_cores();
  long_work::ProgressBar bar = progress_bar(console, arguments.output, subsets_to_try(design));
  options.progress = [&](std::size_t done) { bar.show(done); };
  std::vector<Baseline> table;
  try {
    table = baselines(design, options);
  } catch (const std::invalid_argument& error) {
    throw files::FileError(arguments.design + ": " + error.what());
  }
  bar.clear();
  if (!arguments.csv.empty()) {
    require_other_file("--csv", arguments.csv, {arguments.design});
    files::write_file_atomically(arguments.csv, baselines_as_csv(design, table));
  }
  print_result(
      console, arguments.output,
      [&] {
        return nlohmann::ordered_json{{"design", design.hash}, {"baselines", baselines_as_json(design, table)}};
      },
      [&](std::ostream& out) { print_baselines(table, out); });
}

}  // namespace

void add_baselines_command(CLI::App& app, Action& run) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("baselines", "A design beside subsets, SVD, full-order filters and the limit");
  command->add_option("design", arguments->design, "Design file")->required()->type_name("D.json");
  command->add_option("--subset", arguments->options.named_subset, "Health parameters to serve as tuners, one more row")
      ->type_name("NAME");
  command
      ->add_option("--run-s", arguments->options.run_s,
                   "Time that the time-varying filter has, s; at most a million samples")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--csv", arguments->csv, "Table to write, with every channel")->type_name("F.csv");
  add_output_options(*command, arguments->output);
  command->callback([arguments, &run] { run = [arguments](const Console& console) { compare(*arguments, console); }; });
}

}  // namespace ehm::tuner_design
