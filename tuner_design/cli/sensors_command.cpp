// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/sensors_command.h"

#include <memory>
#include <ostream>

#include "deploy/runtime/files/atomic_file.h"
#include "deploy/runtime/files/csv_table.h"
#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/long_work/parallel_for.h"
#include "tuner_design/cli/design_command.h"
#include "tuner_design/cli/import_options.h"
#include "tuner_design/cli/sensor_costs.h"
#include "tuner_design/print/sensor_text.h"

namespace ehm::tuner_design {
namespace {

struct Arguments {
  std::string model, csv;
  std::vector<std::string> costs, keep;
  double qh_percent2 = design::DesignOptions{}.qh_percent2;
  WeightArguments weights;
  ImportOptions import;
  SensorChoice choice;
  OutputOptions output;
};

SensorChoice choice_of(const Arguments& arguments, const std::vector<linear_model::Channel>& sensors) {
  SensorChoice choice = arguments.choice;
  choice.cost = sensor_costs(sensors, arguments.costs);
  for (const std::string& name : arguments.keep)
    choice.keep |= CandidateSet{1} << sensor_index(sensors, name, "--keep " + name);
  return choice;
}

SensorProblem problem_of(const Arguments& arguments, const linear_model::LinearModel& model) {
  try {
    return sensor_problem(model, arguments.qh_percent2, weights_of(arguments.weights, model));
  } catch (const std::invalid_argument& error) {
    throw files::FileError(arguments.model + ": " + error.what());
  }
}

/// A model may have more sensors here than a design may.
linear_model::LinearModel candidates_of(const Arguments& arguments) {
  return import_model(arguments.model, arguments.import, max_candidates).model;
}

void select(const Arguments& arguments, const Console& console) {
  const linear_model::LinearModel model = candidates_of(arguments);
  SensorReport report;
  report.choice = choice_of(arguments, model.sensors);
  const SensorProblem problem = problem_of(arguments, model);
  long_work::ProgressBar bar = progress_bar(console, arguments.output, std::size_t{problem.every()});
  report.front = sensor_front(problem, report.choice, long_work::all_cores(),
                              [&](std::size_t done, std::size_t total) { bar.show(problem.every() - (total - done)); });
  bar.clear();
  if (report.front.sets == 0) {
    throw files::FileError(arguments.model + ": --keep, --budget " + files::shortest(report.choice.budget) +
                           " and --max-sensors " + std::to_string(report.choice.max_sensors) +
                           " allow no set of sensors; raise the budget or the number");
  }
  report.all = value_of(problem, problem.every());
  report.without = without_each(problem);
  report.without_any = fleet_merit(problem);
  if (!arguments.csv.empty()) {
    require_other_file("--csv", arguments.csv, {arguments.model});
    files::write_file_atomically(arguments.csv, front_as_csv(problem, report.front));
  }
  print_result(
      console, arguments.output, [&] { return sensors_as_json(problem, report); },
      [&](std::ostream& out) { print_sensors(problem, report, out); });
}

}  // namespace

void add_sensors_command(CLI::App& app, Action& run) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("sensors", "Which sensors are worth having: cost against accuracy");
  command->add_option("model", arguments->model, std::string(model_help) + "; with all candidates, at most 20 sensors")
      ->required()
      ->type_name("MODEL");
  command->add_option("--cost", arguments->costs, "NAME=VALUE, or a CSV file with the columns sensor,cost; default 1")
      ->type_name("COST");
  command->add_option("--keep", arguments->keep, "Sensor that every set must have")->type_name("NAME");
  command->add_option("--budget", arguments->choice.budget, "Largest cost of a set")
      ->check([](const std::string& text) -> std::string {
        const auto budget = files::parse_number(text);
        return budget && *budget >= 0.0 ? "" : "'" + text + "' is not a finite number, 0 or above";
      });
  command->add_option("--max-sensors", arguments->choice.max_sensors, "Largest number of sensors of a set")
      ->check(CLI::Range(1, max_candidates));
  add_qh_option(*command, arguments->qh_percent2);
  add_weight_options(*command, arguments->weights);
  command->add_option("--csv", arguments->csv, "Front to write")->type_name("F.csv");
  add_import_options(*command, arguments->import);
  add_output_options(*command, arguments->output);
  command->callback([arguments, &run] { run = [arguments](const Console& console) { select(*arguments, console); }; });
}

}  // namespace ehm::tuner_design
