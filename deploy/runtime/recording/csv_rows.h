// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rows from a CSV file by a column map. The whole file is read and checked first, so that a mistake in its last line
// stops a run before it starts.
//
// Each engine's rows are numbered from 0; time starts where the file's does (1970 for equidistant rows). An empty cell
// or "nan" of a sensor is a missing value: its validity bit is off. Everywhere else a number must stand. Sensors and
// actuators leave in the units that the map declares, flight channels in those of their names.
//
// Times must rise, unless the map says time_may_repeat: then the monitor takes its steps from the rows' order, and rows
// of one time count as received evenly until the next one, so that a replay keeps the pace.
//
// @throws files::FileError naming file, line, column, value and what is allowed.

#include <map>
#include <vector>

#include "deploy/runtime/files/csv_table.h"
#include "deploy/runtime/recording/column_map.h"
#include "deploy/runtime/recording/row_source.h"

namespace ehm::recording {

class CsvRows : public RowSource {
 public:
  CsvRows(const std::string& file, ColumnMap map);

  bool next(Row& row) override;
  const FileInfo& info() const override { return info_; }
  std::string design_hash(const Row&) const override { return {}; }

 private:
  struct Place {  ///< a column that has been found, and how messages name it
    std::size_t index = 0;
    std::string name;
  };
  struct Parsed {
    std::uint32_t engine_id;
    std::uint64_t sequence;
    std::int64_t time_ns, received_ns;
  };
  Place find(const Column& column, const files::CsvRow* header) const;
  void require_names(const files::CsvRow& header) const;
  void require_cells(const files::CsvRow& row) const;
  void find_columns(const files::CsvRow* header);
  std::optional<double> number_at(const files::CsvRow& row, const Place& place) const;
  std::string decimal_hint(const std::string& cell) const;
  void parse(const files::CsvRow& row);
  std::uint32_t parse_engine(const files::CsvRow& row) const;
  std::int64_t parse_time(const files::CsvRow& row, std::uint32_t engine, std::uint64_t sequence);
  void require_later(const files::CsvRow& row, std::uint32_t engine, std::int64_t time_ns) const;
  void spread_repeats();
  double parse_value(const files::CsvRow& row, const MappedChannel& channel, const Place& place, bool may_miss) const;
  [[noreturn]] void refuse(const files::CsvRow& row, const Place& place, const std::string& allowed) const;

  std::string file_;
  ColumnMap map_;
  FileInfo info_;
  Place engine_column_, time_column_;
  std::vector<MappedChannel> channels_;  ///< flight, actuators, sensors
  std::vector<Place> places_;            ///< of the channels
  std::size_t needed_cells_ = 0;
  std::map<std::uint32_t, std::uint64_t> rows_of_;
  std::map<std::uint32_t, std::int64_t> last_time_ns_;
  std::vector<Parsed> parsed_;
  std::vector<double> values_;  ///< of all rows, as many as channels each
  std::size_t position_ = 0;
};

}  // namespace ehm::recording
