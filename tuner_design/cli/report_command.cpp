// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/report_command.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <ostream>

#include "deploy/runtime/files/atomic_file.h"
#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/long_work/parallel_for.h"
#include "monitor/design/design_file.h"
#include "tuner_design/cli/engine_option.h"
#include "tuner_design/cli/studies/study_table.h"
#include "tuner_design/print/design_text.h"
#include "tuner_design/report/design_page.h"

namespace ehm::tuner_design {
namespace {

struct ReportArguments {
  std::string design, out, csv_folder;
  std::vector<std::string> studies;  ///< names of study_table.h, or "all"
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

/// What --studies names, each result once, in the order of the table.
std::vector<const StudyKind*> wanted_studies(const std::vector<std::string>& names) {
  const auto named = [&](const StudyKind& kind) {
    return std::ranges::any_of(names, [&](const std::string& name) {
      return name == "all" || study_kind(name).result == std::string_view(kind.name);
    });
  };
  std::vector<const StudyKind*> wanted;
  for (const StudyKind& kind : study_kinds())
    if (kind.in_a_report && kind.result == std::string_view(kind.name) && named(kind)) wanted.push_back(&kind);
  return wanted;
}

/// As `tuner_design study NAME` has it by default; one that cannot be flown says why.
report::Section section_of(const StudyKind& kind, const ReportArguments& arguments, const StudyProgress& progress) {
  StudyArguments study;
  study.study = kind.name;
  study.engine = arguments.engine;
  study.options.threads = arguments.threads;
  study.faults.design = arguments.design;
  try {
    report::Section section = kind.run(study, progress).section();
    section.add_text("Made as by: tuner_design study " + study.study + " --engine " + study.engine.name_or_file +
                     (kind.of_a_design ? " --design " + study.faults.design : "") + " --seed " +
                     std::to_string(study.options.seed));
    return section;
  } catch (const std::exception& error) {
    report::Section section{"not-flown-" + study.study, "Study " + study.study};
    section.add_text("It could not be run: " + std::string(error.what()) + ".");
    return section;
  }
}

/// The design's page, the studies that were asked for before its last section, which says where all comes from.
report::Page page_of(const design::Design& design, const ReportArguments& arguments, const Console& console) {
  long_work::ProgressBar bar = progress_bar(console, arguments.output, long_work::ProgressBar::shares);
  const std::vector<const StudyKind*> studies = wanted_studies(arguments.studies);
  const double parts = static_cast<double>(studies.size() + 1);
  std::size_t done = 0;
  const auto progress = [&](double share) { bar.show_share((static_cast<double>(done) + share) / parts); };
  report::Page page = report::design_page(design, report::run_studies(design, {.quick = arguments.quick,
                                                                               .engine = arguments.engine.engine(),
                                                                               .threads = arguments.threads,
                                                                               .progress = progress}));
  for (const StudyKind* kind : studies) {
    ++done;
    page.sections.insert(page.sections.end() - 1, section_of(*kind, arguments, progress));
  }
  return page;
}

void write_report(const ReportArguments& arguments, const Console& console) {
  const design::Design design = design::read_design(arguments.design);
  std::error_code absent;
  if (std::filesystem::equivalent(arguments.design, arguments.out, absent))
    throw files::FileError(arguments.out + ": --out is the design itself; name another file for the report");
  const report::Page page = page_of(design, arguments, console);
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
  std::vector<std::string> names = report_study_names();
  names.emplace_back("all");
  command
      ->add_option("--studies", arguments->studies,
                   "Also run these studies, as `tuner_design study NAME` has them by default, and add their tables and "
                   "figures; comma between them; all takes hours")
      ->delimiter(',')
      ->check(CLI::IsMember(names))
      ->type_name("NAME,NAME|all");
  add_engine_option(*command, arguments->engine,
                    "Engine of the Monte Carlo and the studies; if the design is for another one, it is left out");
  command->add_option("--threads", arguments->threads, "The result does not depend on it; default: one a core")
      ->check(CLI::Range(1, 1024));
  add_output_options(*command, arguments->output);
  command->callback(
      [arguments, &run] { run = [arguments](const Console& console) { write_report(*arguments, console); }; });
}

}  // namespace ehm::tuner_design
