// SPDX-License-Identifier: Apache-2.0
#pragma once
// The two input files of fit_maps, both JSON.
//
// Settings: all keys are required unless marked optional; any object may hold a comment "why": "text".
//   namespace        of the generated code, ehm::engine_sim::<namespace>, and stem of its files; lower case
//   include_folder   optional: folder of the generated header as the project includes it; without, the header's name
//   source           where the tables come from; one line, becomes a comment of the generated code
//   compressors      list of {
//     name                 key of the map in the file of tables; its lower case names the accessor and its arrays
//     flow_exponent, pressure_exponent     a and b of compressor_map.h, 0.1 to 10: the slopes of ln Wc and ln(PR - 1)
//                                          over ln n on the lowest speed lines
//     speed_breaks, r_line_breaks          break points of the three surfaces, 2 to 40, ascending; the table with its
//                                          continuation (compressor_table.h) is the range allowed
//     surge_flow_breaks                    of PRsurge(Wc), within the flows of the first R-line
//     corner               optional: {at, moved_to}, a speed line where the table bends, and whereto the bend goes
//     straight_flow, straight_efficiency   optional: where the surface is kept straight, path_settings.h }
//   turbines         list of {name, choking_rate (k of turbine_map.h, 0.01 to 100), speed_breaks,
//                    pressure_ratio_breaks (within the table)}
//
// Tables (map_tables.h): one object a map, under its name; further keys are ignored. A vector may stand in a row of its
// own, [[...]]; a table has one row a speed, and one column an R-line or a pressure ratio.
//   compressor   NcVec      n = corrected speed over that of the design, 0.01 to 3
//                RlineVec   R-lines, the first is the surge line R = 1, 2 lies near the best efficiency, 3 near choke
//                WcArray    corrected flow, lbm/s at 518.67 R and 14.696 psia
//                PRArray, EffArray   pressure ratio and isentropic efficiency (at most 1); PR = 1 or efficiency = 0
//                           mark clipped samples, which count nothing
//   turbine      NcVec      speed parameter, percent of design     PRVec   expansion ratio, 1.01 to 100
//                WcArray    w sqrt(T)/p, lbm/s sqrt(R)/psia         EffArray   isentropic efficiency, 0 to 1

#include <optional>
#include <string>
#include <vector>

#include "engine_sim/map_fit/compressor_table.h"
#include "engine_sim/map_fit/path_settings.h"

namespace ehm::engine_sim {

/// Where settings stand, for messages of what shows only beside the tables.
struct SettingsPlace {
  std::string file, key;
};

struct CompressorSettings {
  SettingsPlace place;
  std::string name;
  double flow_exponent, pressure_exponent;
  std::vector<double> speed_breaks, r_line_breaks, surge_flow_breaks;
  std::optional<Corner> corner;
  std::optional<PathSettings> straight_flow, straight_efficiency;
};

struct TurbineSettings {
  SettingsPlace place;
  std::string name;
  double choking_rate;
  std::vector<double> speed_breaks, pressure_ratio_breaks;
};

struct FitSettings {
  std::string file;
  std::string name_space;
  std::string include_folder;  ///< may be empty
  std::string source;
  std::vector<CompressorSettings> compressors;
  std::vector<TurbineSettings> turbines;
};

/// @throws files::FileError naming file, key, value and allowed range if a key is missing, unknown, repeated, of the
///         wrong type or out of range, if two maps share their lower-case name, or if there is no map at all
FitSettings read_fit_settings(const std::string& file);

/// Name of a map's accessor in the generated code.
std::string lower_case(std::string name);

}  // namespace ehm::engine_sim
