// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/figures/maps_command.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <ostream>

#include "deploy/runtime/files/atomic_file.h"
#include "deploy/runtime/files/file_error.h"
#include "engine_sim/engines/shipped_engines.h"
#include "engine_sim/figures/engine_figures.h"
#include "engine_sim/figures/gnuplot.h"

namespace ehm::engine_sim {
namespace {

struct Arguments {
  std::string out, reference, engine = "jt9d";
};

void make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder))
    throw files::FileError(folder + ": is no folder and cannot be made: " + error.message());
}

void draw_maps(const Arguments& arguments, std::ostream& out) {
  std::optional<files::CsvTable> reference;
  if (!arguments.reference.empty()) reference = files::read_csv(arguments.reference);
  const std::vector<Figure> figures = engine_figures(named_engine(arguments.engine)->data, reference);
  make_folder(arguments.out);
  for (const Figure& figure : figures) {
    const std::string path = arguments.out + "/" + figure.name;
    files::AtomicFile picture(path + ".svg");
    run_gnuplot(figure.script, picture.descriptor());
    picture.commit();
    files::write_file_atomically(path + ".csv", figure_csv(figure));
    out << path << ".svg, " << path << ".csv\n";
  }
}

}  // namespace

void add_maps_command(CLI::App& app, std::function<void(std::ostream&, std::ostream&)>& run) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("maps", "Pictures of the five component maps, with what they show as CSV");
  command->add_option("--out", arguments->out, "Folder for the pictures (SVG) and their numbers (CSV)")
      ->required()
      ->type_name("DIR");
  command->add_option("--engine", arguments->engine, "Engine: a shipped one (" + shipped_engine_names() + ") or a file")
      ->type_name("NAME|FILE")
      ->capture_default_str();
  command
      ->add_option("--reference", arguments->reference,
                   "Points of another model to draw, with NPSS's columns Fan_NcMap, Fan_WcMap, Fan_PRmap, Fan_effMap "
                   "and so on for LPC, HPC, HPT, LPT")
      ->type_name("FILE.csv");
  command->footer(
      "Drawn by gnuplot (package gnuplot-nox). Each picture shows speed lines, contours of efficiency, the\n"
      "surge line of a compressor, and the operating line at sea level and at cruise.");
  command->callback(
      [arguments, &run] { run = [arguments](std::ostream& out, std::ostream&) { draw_maps(*arguments, out); }; });
}

}  // namespace ehm::engine_sim
