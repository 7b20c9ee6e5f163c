// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/map_fit/fit_maps_command.h"

#include <CLI/CLI.hpp>
#include <ostream>
#include <stdexcept>
#include <string>

#include "deploy/runtime/config/usage_answer.h"
#include "deploy/runtime/files/atomic_file.h"
#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/service/exit_code.h"
#include "engine_sim/map_fit/map_source.h"

namespace ehm::engine_sim {
namespace {

constexpr const char* formats =
    "SETTINGS.json (example: engine_sim/engines/jt9d_fit.json; \"why\": \"text\" is a comment anywhere):\n"
    "  namespace, source, optional include_folder\n"
    "  compressors: list of {name, flow_exponent, pressure_exponent, speed_breaks, r_line_breaks, surge_flow_breaks,\n"
    "    optional corner {at, moved_to}, optional straight_flow and straight_efficiency {speed_from, speed_to,\n"
    "    speed_step, r_line_by_speed [[n, R], ...], r_line_extent, points_along, speed_per_r_line, r_line_step, "
    "weight}}\n"
    "  turbines: list of {name, choking_rate, speed_breaks, pressure_ratio_breaks}\n"
    "MAPS.json: one object a map, under its name; tables have one row a speed\n"
    "  compressor: NcVec (corrected speed / design), RlineVec (1 is surge), WcArray (lbm/s), PRArray, EffArray\n"
    "  turbine: NcVec (percent of design), PRVec, WcArray (lbm/s sqrt(R)/psia), EffArray\n"
    "Meaning and ranges of every key: engine_sim/map_fit/fit_settings.h.\n";

struct Arguments {
  std::string settings, maps, folder;
};

/// Runs a fit; what does not determine its coefficients is a mistake of the settings.
template <class Fit>
auto named(const SettingsPlace& place, const Fit& fit) {
  try {
    return fit();
  } catch (const files::FileError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw files::FileError(place.file + ": " + place.key + ": " + error.what());
  }
}

MapFits fit_all(const FitSettings& settings, const std::string& maps_file) {
  const files::Json maps = files::parse_json_file(maps_file);
  MapFits fits;
  for (const CompressorSettings& s : settings.compressors) {
    const CompressorTable table = read_compressor_table(maps, maps_file, s.name);
    fits.compressors.push_back(named(s.place, [&] { return fit_compressor(s, table); }));
    fits.compressor_deviations.push_back(deviation_text(s, fits.compressors.back(), table));
  }
  for (const TurbineSettings& s : settings.turbines) {
    const TurbineTable table = read_turbine_table(maps, maps_file, s.name);
    fits.turbines.push_back(named(s.place, [&] { return fit_turbine(s, table); }));
    fits.turbine_deviations.push_back(deviation_text(s, fits.turbines.back(), table));
  }
  return fits;
}

void fit_to_files(const Arguments& arguments, std::ostream& out) {
  const FitSettings settings = read_fit_settings(arguments.settings);
  const MapFits fits = fit_all(settings, arguments.maps);
  const std::string stem = arguments.folder + "/" + settings.name_space;
  files::write_file_atomically(stem + ".cpp", source_text(settings, fits));
  files::write_file_atomically(stem + ".h", header_text(settings));
  for (const std::string& line : fits.compressor_deviations) out << line << '\n';
  for (const std::string& line : fits.turbine_deviations) out << line << '\n';
  out << "written to " << stem << ".cpp and " << stem << ".h\n";
}

}  // namespace

int run_fit_maps(int argc, const char* const* argv, std::ostream& out, std::ostream& err) {
  Arguments arguments;
  CLI::App app("Fits smooth component maps to tables and writes them as C++ for an engine file.", "fit_maps");
  app.footer(std::string(formats) + service::exit_code_help);
  app.add_option("settings", arguments.settings, "How to fit which maps")->required()->type_name("SETTINGS.json");
  app.add_option("maps", arguments.maps, "Tables of the maps")->required()->type_name("MAPS.json");
  app.add_option("out", arguments.folder, "Folder for NAMESPACE.cpp and NAMESPACE.h")
      ->required()
      ->type_name("OUT_FOLDER")
      ->check(CLI::ExistingDirectory);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return config::usage_answer(app, error, out, err);
  }
  try {
    fit_to_files(arguments, out);
    return service::exit_ok;
  } catch (const files::FileError& error) {
    err << "fit_maps: " << error.what() << '\n';
    return service::exit_usage;
  } catch (const std::exception& error) {
    err << "fit_maps: " << error.what() << '\n';
    return service::exit_failed;
  }
}

}  // namespace ehm::engine_sim
