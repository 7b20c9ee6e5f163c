// SPDX-License-Identifier: Apache-2.0
#pragma once
// Which column of a CSV file is which channel: a TOML file. Columns count from 1, or are named where there is a header.
//
//   [file]      separator = "comma", "semicolon", "tab" or "blank", header = true or false,
//               decimal = "point" (default) or "comma",
//               engine_id_column or engine_id, and either sample_time_s or time_column with seconds_per_unit and
//               time_may_repeat = true for a coarse clock (default false): times that repeat or step back by up to 2 s
//   [[flight]]  [[actuator]]  [[sensor]]   name, and either column with factor and offset, or value
//
//   value in the channel's unit = factor * cell + offset
//
// The channel's unit is the one that the map gives it; without one it is the design's, of a flight channel that of its
// name. Where the design has another unit, whoever feeds the design converts (deploy/runtime/units); flight channels
// are converted here, so that they leave in the units of their names.
//
// The three flight channels must all be there; actuators and sensors stand in the order of the design.
//
// @throws config::ConfigError with file, line, key, value, allowed range.

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "deploy/runtime/files/table_check.h"

namespace ehm::recording {

using Column = std::variant<std::size_t, std::string>;  ///< number from 1, or name in the header

struct MappedChannel {
  std::string name, unit;
  bool constant = false;
  double value = 0.0;  ///< of a constant
  Column column = std::size_t{1};
  double factor = 1.0, offset = 0.0;
};

struct ColumnMap {
  files::Separator separator = files::Separator::comma;
  bool header = false;
  std::optional<char> decimal;  ///< point or comma, where the map says which
  bool engine_id_constant = false;
  std::uint32_t engine_id = 1;  ///< if constant
  Column engine_id_column = std::size_t{1};
  bool equidistant = false;
  double sample_time_s = 0.0;  ///< if equidistant
  Column time_column = std::size_t{1};
  double seconds_per_unit = 1.0;
  bool time_may_repeat = false;
  std::vector<MappedChannel> flight;  ///< altitude_m, mach, delta_isa_k
  std::vector<MappedChannel> actuators, sensors;
};

ColumnMap read_column_map(const std::string& file);

}  // namespace ehm::recording
