// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/map_fit/map_tables.h"

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/numbers/index.h"
#include "engine_sim/map_fit/checked_numbers.h"

namespace ehm::engine_sim {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using files::JsonObject;
using files::shown;
using files::throw_defect;

constexpr std::size_t most_lines = 60;

struct Columns {
  const char* key;  ///< of the vector that belongs to the columns
  std::size_t count;
};

/// A table with one row a speed. @throws files::FileError if its shape or an entry is wrong
MatrixXd table(JsonObject& map, const std::string& key, std::size_t speeds, const Columns& columns, double low,
               double high) {
  const files::Json& rows = map.array(key);
  const std::string remedy = std::string("One row a speed of NcVec, one column an entry of ") + columns.key;
  if (rows.size() != speeds) {
    throw_defect(map.file(), map.key(key), std::to_string(rows.size()) + " rows high",
                 std::to_string(speeds) + " rows of " + std::to_string(columns.count) + " numbers", remedy);
  }
  for (std::size_t i = 0; i < speeds; ++i) {
    if (rows[i].is_array() && rows[i].size() == columns.count) continue;
    throw_defect(map.file(), map.key(key) + "[" + std::to_string(i) + "]",
                 rows[i].is_array() ? std::to_string(rows[i].size()) + " numbers long" : shown(rows[i]),
                 std::to_string(columns.count) + " numbers", remedy);
  }
  const MatrixXd z = map.matrix(key, as_index(speeds), as_index(columns.count));
  for (Index i = 0; i < z.rows(); ++i) {
    for (Index j = 0; j < z.cols(); ++j) {
      if (z(i, j) >= low && z(i, j) <= high) continue;
      throw_defect(map.file(), map.key(key) + "[" + std::to_string(i) + "][" + std::to_string(j) + "]", shown(z(i, j)),
                   "a number from " + range_text(low, high), "Check its unit");
    }
  }
  return z;
}

/// What the continuation of compressor_table.h needs: the last two samples of each speed line that count, and an R-line
/// of full weight on both of the highest speed lines.
void check_unclipped(const CompressorTable& t, const JsonObject& map) {
  const auto weight = [&](Index i, Index j) {
    return sample_weight(t.r_line[as_size(j)], t.pressure_ratio(i, j), t.efficiency(i, j));
  };
  const Index rows = t.flow.rows(), columns = t.flow.cols();
  bool edge = false;
  for (Index j = 0; j < columns; ++j) edge = edge || (weight(rows - 1, j) >= 1.0 && weight(rows - 2, j) >= 1.0);
  for (Index i = 0; i < rows; ++i) {
    Index last = columns - 1;
    while (last > 0 && weight(i, last) <= 0.0) --last;
    if (last > 0 && weight(i, last - 1) > 0.0) continue;
    throw_defect(
        map.file(), map.key("PRArray") + "[" + std::to_string(i) + "]", "clipped (or EffArray is)",
        "at least two neighbouring samples with PR above 1.001 and efficiency above 0.05 before the clipped end",
        "Leave this speed line out");
  }
  if (edge) return;
  throw_defect(map.file(), map.key("EffArray"), "below 0.5 or clipped on the two highest speed lines",
               "an R-line from 1.3 to 2.7 with an efficiency of 0.5 or more on both of them",
               "Leave the highest speed line out");
}

}  // namespace

CompressorTable read_compressor_table(const files::Json& maps, const std::string& file, const std::string& name) {
  JsonObject root(maps, file, "");
  JsonObject map(root.at(name), file, name);
  CompressorTable t;
  t.speed = ascending_numbers(map, "NcVec", 3, most_lines, 0.01, 3.0);
  t.r_line = ascending_numbers(map, "RlineVec", 3, most_lines, 1.0, 20.0);
  if (t.r_line.front() != 1.0) {
    throw_defect(file, map.key("RlineVec") + "[0]", shown(t.r_line.front()), "1, the surge line",
                 "Renumber the R-lines so that 1 is surge and 2 the best efficiency");
  }
  const Columns columns{"RlineVec", t.r_line.size()};
  t.flow = table(map, "WcArray", t.speed.size(), columns, 1e-6, 1e6);
  t.pressure_ratio = table(map, "PRArray", t.speed.size(), columns, 0.01, 1000.0);
  t.efficiency = table(map, "EffArray", t.speed.size(), columns, -10.0, 1.0);
  check_unclipped(t, map);
  return t;
}

TurbineTable read_turbine_table(const files::Json& maps, const std::string& file, const std::string& name) {
  JsonObject root(maps, file, "");
  JsonObject map(root.at(name), file, name);
  TurbineTable t;
  t.speed = ascending_numbers(map, "NcVec", 3, most_lines, 1e-3, 1e4);
  t.pressure_ratio = ascending_numbers(map, "PRVec", 3, most_lines, 1.01, 100.0);
  const Columns columns{"PRVec", t.pressure_ratio.size()};
  t.flow = table(map, "WcArray", t.speed.size(), columns, 1e-6, 1e6);
  t.efficiency = table(map, "EffArray", t.speed.size(), columns, 0.0, 1.0);
  return t;
}

}  // namespace ehm::engine_sim
