// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/figures/reference_points.h"

#include "deploy/runtime/files/file_error.h"

namespace ehm::engine_sim {
namespace {

std::size_t require_column(const files::CsvTable& table, const std::string& name) {
  const auto column = table.column(name);
  if (!column) throw files::FileError(table.place(table.header) + ": column '" + name + "' is missing");
  return *column;
}

double number_in(const files::CsvTable& table, const files::CsvRow& row, std::size_t column) {
  const auto number = files::parse_number(row.cells[column]);
  if (!number)
    throw files::FileError(table.place(row) + ": '" + table.header.cells[column] + "' is " +
                           files::in_quotes(row.cells[column]) + ", allowed is a finite number");
  return *number;
}

}  // namespace

std::vector<ReferencePoint> reference_points(const files::CsvTable& table, const std::string& component) {
  const std::size_t speed = require_column(table, component + "_NcMap"),
                    flow = require_column(table, component + "_WcMap"),
                    pressure_ratio = require_column(table, component + "_PRmap"),
                    efficiency = require_column(table, component + "_effMap");
  const auto converged = table.column("conv");
  std::vector<ReferencePoint> points;
  for (const files::CsvRow& row : table.rows) {
    if (converged && number_in(table, row, *converged) != 1.0) continue;
    points.push_back({number_in(table, row, speed), number_in(table, row, flow), number_in(table, row, pressure_ratio),
                      number_in(table, row, efficiency)});
  }
  return points;
}

}  // namespace ehm::engine_sim
