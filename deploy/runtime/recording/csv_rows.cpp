// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/recording/csv_rows.h"

#include <algorithm>
#include <cmath>

#include "deploy/runtime/files/file_error.h"

namespace ehm::recording {

using files::CsvRow;
using files::FileError;

namespace {

constexpr std::uint32_t wire_schema = 1, csv_source_id = 1;
constexpr double largest_time_s = 9e9;                        // what 64 bits of nanoseconds hold
constexpr std::int64_t longest_step_back_ns = 2'000'000'000;  // the monitor's checks.restart_gap_s by default

bool says_missing(std::string_view cell) {
  return cell.empty() || cell == "nan" || cell == "NaN" || cell == "NAN";
}

std::vector<Channel> described(const std::vector<MappedChannel>& channels) {
  std::vector<Channel> all;
  for (const auto& channel : channels) all.push_back({channel.name, channel.unit});
  return all;
}

}  // namespace

CsvRows::CsvRows(const std::string& file, ColumnMap map) : file_(file), map_(std::move(map)) {
  info_.channels.actuators = described(map_.actuators);
  info_.channels.sensors = described(map_.sensors);
  info_.sample_time_s = map_.sample_time_s;
  for (const auto* group : {&map_.flight, &map_.actuators, &map_.sensors})
    channels_.insert(channels_.end(), group->begin(), group->end());

  const std::vector<CsvRow> records =
      files::read_records(file, {map_.separator, map_.header, map_.decimal == ',', true});
  const std::size_t first = map_.header ? 1 : 0;
  if (records.size() <= first) throw FileError(file + ": has no row" + (map_.header ? " below its header" : ""));
  if (map_.header) require_names(records.front());
  find_columns(map_.header ? &records.front() : nullptr);
  require_cells(records.front());
  for (std::size_t i = first; i < records.size(); ++i) parse(records[i]);
  if (map_.time_may_repeat) spread_repeats();
}

void CsvRows::require_names(const CsvRow& header) const {
  const auto is_number = [](const std::string& cell) { return files::parse_number(cell).has_value(); };
  if (std::all_of(header.cells.begin(), header.cells.end(), is_number))
    throw FileError(file_ + ":" + std::to_string(header.line) +
                    ": the header holds numbers only; if the file has none, the column map needs header = false");
}

void CsvRows::require_cells(const CsvRow& row) const {
  if (row.cells.size() >= needed_cells_) return;
  std::string hint;
  for (const auto& [letter, name] : {std::pair{';', "semicolon"}, {',', "comma"}, {'\t', "tab"}, {' ', "blank"}})
    if (hint.empty() && row.cells.size() == 1 && row.cells.front().find(letter) != std::string::npos)
      hint = std::string("; is the separator \"") + name + "\"?";
  throw FileError(file_ + ":" + std::to_string(row.line) + ": " + std::to_string(row.cells.size()) +
                  " cells, the column map needs " + std::to_string(needed_cells_) + hint);
}

CsvRows::Place CsvRows::find(const Column& column, const CsvRow* header) const {
  if (const auto* number = std::get_if<std::size_t>(&column)) return {*number - 1, "column " + std::to_string(*number)};
  const auto& name = std::get<std::string>(column);
  const auto found = std::find(header->cells.begin(), header->cells.end(), name);
  if (found == header->cells.end())
    throw FileError(file_ + ":" + std::to_string(header->line) + ": the header has no column '" + name + "'");
  if (std::find(found + 1, header->cells.end(), name) != header->cells.end())
    throw FileError(file_ + ":" + std::to_string(header->line) + ": column '" + name +
                    "' appears twice; name the columns apart, or map them by number");
  return {static_cast<std::size_t>(found - header->cells.begin()), "column '" + name + "'"};
}

void CsvRows::find_columns(const CsvRow* header) {
  const auto use = [&](const Column& column) {
    const Place place = find(column, header);
    needed_cells_ = std::max(needed_cells_, place.index + 1);
    return place;
  };
  if (!map_.engine_id_constant) engine_column_ = use(map_.engine_id_column);
  if (!map_.equidistant) time_column_ = use(map_.time_column);
  for (const auto& channel : channels_) places_.push_back(channel.constant ? Place{} : use(channel.column));
}

void CsvRows::refuse(const CsvRow& row, const Place& place, const std::string& allowed) const {
  throw FileError(file_ + ":" + std::to_string(row.line) + ": " + place.name + " is " +
                  files::in_quotes(row.cells[place.index]) + ", allowed is " + allowed);
}

void CsvRows::parse(const CsvRow& row) {
  const std::uint32_t engine = parse_engine(row);
  const std::uint64_t sequence = rows_of_[engine]++;
  const std::int64_t time_ns = parse_time(row, engine, sequence);
  parsed_.push_back({engine, sequence, time_ns, time_ns});
  const std::size_t first_sensor = map_.flight.size() + map_.actuators.size();
  for (std::size_t i = 0; i < channels_.size(); ++i)
    values_.push_back(parse_value(row, channels_[i], places_[i], i >= first_sensor));
}

std::optional<double> CsvRows::number_at(const CsvRow& row, const Place& place) const {
  const auto number = files::parse_number(row.cells[place.index], map_.decimal.value_or('.'));
  if (!number || map_.header || map_.decimal || map_.separator != files::Separator::comma) return number;
  if (files::is_torn_off(row, place.index))
    refuse(row, place,
           "a number without leading zeros; is it torn off the column before by a decimal comma, or a comma for "
           "thousands? If not, the column map's [file] may say decimal = \"point\"");
  return number;
}

/// Why a cell may not be the number that it looks like.
std::string CsvRows::decimal_hint(const std::string& cell) const {
  const char decimal = map_.decimal.value_or('.'), other = decimal == ',' ? '.' : ',';
  const auto sign = cell.find(other);
  if (sign == std::string::npos) return "";
  std::string with_other = cell;
  std::replace(with_other.begin(), with_other.end(), decimal, 'x');
  if (!files::parse_number(with_other, other)) return "";
  // 752,747 may be either
  if (other == ',' && cell.size() - sign == 4 && cell[0] != '0')
    return "; is the comma one for thousands? Write none; if it is a decimal one, the column map's [file] says "
           "decimal = \"comma\"";
  return std::string("; the column map's [file] says decimal = \"") + (other == ',' ? "comma" : "point") +
         "\" for files written so";
}

std::uint32_t CsvRows::parse_engine(const CsvRow& row) const {
  if (map_.engine_id_constant) return map_.engine_id;
  const auto number = files::parse_number(row.cells[engine_column_.index], map_.decimal.value_or('.'));
  if (!number || *number < 1 || *number > 4294967295.0 || *number != std::floor(*number))
    refuse(row, engine_column_, "an engine id: a whole number from 1 to 4294967295");
  return static_cast<std::uint32_t>(*number);
}

std::int64_t CsvRows::parse_time(const CsvRow& row, std::uint32_t engine, std::uint64_t sequence) {
  if (map_.equidistant) return std::llround(1e9 * map_.sample_time_s * static_cast<double>(sequence));
  const auto number = number_at(row, time_column_);
  if (!number || std::abs(*number * map_.seconds_per_unit) > largest_time_s)
    refuse(row, time_column_, "a time within 9e9 s" + decimal_hint(row.cells[time_column_.index]));
  const std::int64_t time_ns = std::llround(1e9 * map_.seconds_per_unit * *number);
  require_later(row, engine, time_ns);
  last_time_ns_[engine] = time_ns;
  return time_ns;
}

void CsvRows::require_later(const CsvRow& row, std::uint32_t engine, std::int64_t time_ns) const {
  const auto last = last_time_ns_.find(engine);
  if (last == last_time_ns_.end()) return;
  const std::string before = "than in the row of engine " + std::to_string(engine) + " before";
  if (map_.time_may_repeat) {
    if (time_ns < last->second - longest_step_back_ns)
      refuse(row, time_column_,
             "a time at most 2 s earlier " + before + "; a flight of its own needs a file of its own");
  } else if (time_ns <= last->second) {
    refuse(row, time_column_,
           "a later time " + before +
               "; if it is a coarse clock's, the column map's [file] may say time_may_repeat = true (steps then come "
               "from the order of the rows), or sample_time_s in the place of time_column");
  }
}

void CsvRows::spread_repeats() {
  std::map<std::uint32_t, std::vector<std::size_t>> rows_by_engine;
  for (std::size_t i = 0; i < parsed_.size(); ++i) rows_by_engine[parsed_[i].engine_id].push_back(i);
  for (const auto& [engine, rows] : rows_by_engine) {
    double spacing_ns = 0.0;  // of the latest rows between two times
    for (std::size_t first = 0, next = 0; first < rows.size(); first = next) {
      const std::int64_t time_ns = parsed_[rows[first]].time_ns;
      while (next < rows.size() && parsed_[rows[next]].time_ns <= time_ns) ++next;
      if (next < rows.size())
        spacing_ns = static_cast<double>(parsed_[rows[next]].time_ns - time_ns) / static_cast<double>(next - first);
      for (std::size_t i = first; i < next; ++i)
        parsed_[rows[i]].received_ns = time_ns + std::llround(spacing_ns * static_cast<double>(i - first));
    }
    if (rows.size() > 1 && spacing_ns == 0.0)
      throw FileError(file_ + ": the time of engine " + std::to_string(engine) +
                      " never rises; the column map's [file] needs sample_time_s in the place of time_column");
  }
}

double CsvRows::parse_value(const CsvRow& row, const MappedChannel& channel, const Place& place, bool may_miss) const {
  if (channel.constant) return channel.value;
  const std::string& cell = row.cells[place.index];
  if (may_miss && says_missing(cell)) return no_value;
  const auto number = number_at(row, place);
  if (!number)
    refuse(
        row, place,
        (may_miss ? "a number, or nan for a missing value" : "a number (" + channel.name + ")") + decimal_hint(cell));
  return channel.factor * *number + channel.offset;
}

bool CsvRows::next(Row& row) {
  if (position_ == parsed_.size()) return false;
  const Parsed& parsed = parsed_[position_];
  const double* value = values_.data() + position_ * channels_.size();
  ++position_;
  row = Row{};
  row.a.unit = parsed.engine_id;
  row.a.sequence = static_cast<std::int64_t>(parsed.sequence);
  row.a.source_time_ns = parsed.time_ns;
  row.a.received_ns = parsed.received_ns;
  row.a.schema = wire_schema;
  row.a.source_id = csv_source_id;
  row.a.sensor_count = static_cast<std::int64_t>(map_.sensors.size());
  row.a.actuator_count = static_cast<std::int64_t>(map_.actuators.size());
  row.a.accepted = 1;
  const std::size_t acting = flight_channels + map_.actuators.size();
  std::copy_n(value, acting, row.w.begin());
  std::copy_n(value + acting, map_.sensors.size(), row.x_s.begin());
  for (std::size_t i = 0; i < map_.sensors.size(); ++i)
    if (!std::isnan(row.x_s[i])) row.a.sensor_valid |= std::int64_t{1} << i;
  return true;
}

}  // namespace ehm::recording
