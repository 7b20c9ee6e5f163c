// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/report_command.h"

#include <filesystem>
#include <memory>
#include <ostream>

#include "deploy/runtime/files/atomic_file.h"
#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/long_work/parallel_for.h"
#include "monitor/design/design_file.h"
#include "tuner_design/cli/engine_option.h"
#include "tuner_design/print/design_text.h"
#include "tuner_design/report/design_page.h"

namespace ehm::tuner_design {
namespace {

struct ReportArguments {
  std::string design, out, csv_folder;
  bool quick = false;
  unsigned threads = long_work::all_cores();
  EngineOption engine;
  OutputOptions output;
};

void write_csv_files(const report::Page& page, const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw files::FileError(folder + ": cannot be made a folder: " + error.message());
  for (const report::Section& section : page.sections) {
    for (const auto& [id, table] : section.data)
      files::write_file_atomically(folder + "/" + id + ".csv", report::to_csv(table));
  }
}

nlohmann::ordered_json page_as_json(const report::Page& page, const design::Design& design, const std::string& file) {
  nlohmann::ordered_json tables = nlohmann::ordered_json::object();
  for (const report::Section& section : page.sections) {
    for (const auto& [id, table] : section.data) tables[id] = report::to_json(table);
  }
  return {{"report", file}, {"design", design_as_json(design)}, {"tables", std::move(tables)}};
}

report::Studies studies_of(const design::Design& design, const ReportArguments& arguments, const Console& console) {
  long_work::ProgressBar bar = progress_bar(console, arguments.output, long_work::ProgressBar::shares);
  return report::run_studies(design, {.quick = arguments.quick,
                                      .engine = arguments.engine.engine(),
                                      .threads = arguments.threads,
                                      .progress = [&](double share) { bar.show_share(share); }});
}

void write_report(const ReportArguments& arguments, const Console& console) {
  const design::Design design = design::read_design(arguments.design);
  std::error_code absent;
  if (std::filesystem::equivalent(arguments.design, arguments.out, absent))
    throw files::FileError(arguments.out + ": --out is the design itself; name another file for the report");
  const report::Page page = report::design_page(design, studies_of(design, arguments, console));
  files::write_file_atomically(arguments.out, report::to_html(page));
  if (!arguments.csv_folder.empty()) write_csv_files(page, arguments.csv_folder);
  print_result(
      console, arguments.output, [&] { return page_as_json(page, design, arguments.out); },
      [&](std::ostream& out) {
        out << "Report on " << design.model.name << " written to " << arguments.out << ", hash " << design.hash << '\n';
        if (!arguments.csv_folder.empty())
          out << "Numbers of its figures and tables in " << arguments.csv_folder << '\n';
      });
}

}  // namespace

void add_report_command(CLI::App& app, Action& run) {
  const auto arguments = std::make_shared<ReportArguments>();
  CLI::App* command = app.add_subcommand("report", "Explain a design on one self-contained web page");
  command->add_option("design", arguments->design, "Design file")->required()->type_name("DESIGN.json");
  command->add_option("-o,--out", arguments->out, "Page to write")->required()->type_name("REPORT.html");
  command->add_option("--csv-dir", arguments->csv_folder, "Also write the numbers of each figure and table here")
      ->type_name("DIR");
  command->add_flag("--quick", arguments->quick,
                    "Leave out the Monte Carlo and the papers' tables, which take some seconds");
  add_engine_option(*command, arguments->engine,
                    "Engine of the Monte Carlo; if the design is for another one, it is left out");
  command->add_option("--threads", arguments->threads, "The result does not depend on it; default: one a core")
      ->check(CLI::Range(1, 1024));
  add_output_options(*command, arguments->output);
  command->callback(
      [arguments, &run] { run = [arguments](const Console& console) { write_report(*arguments, console); }; });
}

}  // namespace ehm::tuner_design
