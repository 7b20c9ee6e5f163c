// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/import/csv_folder.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "deploy/runtime/files/csv_table.h"
#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/numbers/index.h"

namespace ehm::tuner_design {
namespace {

using files::CsvRow;
using files::CsvTable;
using files::FileError;

[[noreturn]] void refuse(const std::string& place, const std::string& what, const std::string& text,
                         const std::string& allowed) {
  throw FileError(place + ": " + what + " is " + files::in_quotes(text) + "; allowed: " + allowed + ".");
}

double number(const std::string& cell, const std::string& place, const std::string& column) {
  if (const auto value = files::parse_number(cell)) return *value;
  refuse(place, column, cell, "a finite number, point as decimal sign, commas between numbers");
}

Eigen::MatrixXd read_matrix(const std::string& file) {
  const std::vector<CsvRow> rows = files::read_records(file, {});
  if (rows.empty()) return {};
  Eigen::MatrixXd matrix(rows.size(), rows.front().cells.size());
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    const CsvRow& row = rows[as_size(i)];
    const std::string place = file + ":" + std::to_string(row.line);
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      const auto column = as_size(j);
      matrix(i, j) = number(row.cells[column], place, "column " + std::to_string(j + 1));
      if (files::is_torn_off(row, column))
        refuse(place, "column " + std::to_string(j + 1), row.cells[column],
               "a number without leading zeros; is it torn off the column before by a decimal comma, or a comma for "
               "thousands");
    }
  }
  return matrix;
}

void require_columns(const CsvTable& table, const std::set<std::string>& known, const std::string& allowed) {
  for (const std::string& name : table.header.cells) {
    if (known.count(name) == 0) refuse(table.place(table.header), "a column", name, allowed);
  }
}

/// The cell of a column, empty if the table does not have it.
std::string cell(const CsvTable& table, const CsvRow& row, const char* column) {
  const auto at = table.column(column);
  return at ? row.cells[*at] : "";
}

void append(Eigen::MatrixXd& column, const std::string& text, const std::string& place, const std::string& name) {
  column.conservativeResize(column.rows() + 1, 1);
  column(column.rows() - 1, 0) = text.empty() ? std::nan("") : number(text, place, name);
}

void read_channels(const std::string& file, Variables& variables) {
  const CsvTable table = files::read_csv(file);
  require_columns(table, {"kind", "name", "unit", "trim", "sigma", "resolution", "update_period_s"},
                  "kind, name, unit, trim, sigma, resolution, update_period_s");
  if (!table.column("kind")) throw FileError(table.place(table.header) + ": the column kind is missing. Add it.");
  const std::set<std::string> kinds{"state", "control", "health", "sensor", "auxiliary"};
  for (const CsvRow& row : table.rows) {
    const std::string kind = cell(table, row, "kind"), sigma = cell(table, row, "sigma"), place = table.place(row);
    if (kinds.count(kind) == 0) refuse(place, "kind", kind, "state, control, health, sensor, auxiliary");
    variables.texts[kind + "_names"].push_back(cell(table, row, "name"));
    variables.texts[kind + "_units"].push_back(cell(table, row, "unit"));
    append(variables.numbers[kind + "_trim"], cell(table, row, "trim"), place, "trim");
    if (kind == "health") {
      append(variables.numbers["health_sigma"], sigma, place, "sigma");
    } else if (kind == "sensor") {
      append(variables.numbers["sensor_noise_sigma"], sigma, place, "sigma");
      for (const char* key : {"resolution", "update_period_s"})
        append(variables.numbers[std::string("sensor_") + key], cell(table, row, key), place, key);
    } else if (!sigma.empty()) {
      refuse(place, "sigma of a " + kind, sigma, "empty, since only health and sensors have one");
    }
    for (const char* key : {"resolution", "update_period_s"})
      if (const std::string text = cell(table, row, key); kind != "sensor" && !text.empty())
        refuse(place, key + (" of a " + kind), text, "empty, since only sensors have one");
  }
}

void read_settings(const std::string& file, Variables& variables) {
  const CsvTable table = files::read_csv(file, false);  // values of many kinds
  require_columns(table, {"key", "value"}, "key, value");
  for (const CsvRow& row : table.rows) {
    const std::string key = cell(table, row, "key"), value = cell(table, row, "value"), place = table.place(row);
    const bool is_text = key == "name" || key == "engine_type";
    if (!is_text && !contains(scalar_variables, key))
      refuse(place, "key", key, "Ts, sample_time_s, name, engine_type, altitude_m, mach, delta_isa_k");
    if (variables.numbers.count(key) + variables.texts.count(key) > 0) throw FileError(place + ": " + key + " again.");
    if (is_text) {
      variables.texts[key] = {value};
    } else {
      variables.numbers[key] = Eigen::MatrixXd::Constant(1, 1, number(value, place, key));
    }
  }
}

}  // namespace

Variables read_csv_folder(const std::string& folder) {
  Variables variables;
  variables.path = folder;
  variables.source = folder;
  variables.format = "CSV folder";
  std::error_code error;
  std::set<std::filesystem::path> paths;  // in order, so that messages do not depend on the file system
  for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    paths.insert(it->path());
  if (error) throw FileError(folder + ": cannot be read: " + error.message() + ". Check its permissions.");
  for (const std::filesystem::path& path : paths) {
    const std::string name = path.stem().string();
    if (path.extension() == ".csv" && contains(matrix_variables, name)) {
      variables.numbers[name] = read_matrix(path.string());
    } else if (path.filename() == "channels.csv") {
      read_channels(path.string(), variables);
    } else if (path.filename() == "settings.csv") {
      read_settings(path.string(), variables);
    } else {
      variables.ignored.push_back(path.filename().string());
    }
  }
  return variables;
}

}  // namespace ehm::tuner_design
