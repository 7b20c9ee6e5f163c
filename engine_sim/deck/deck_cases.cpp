// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/deck/deck_cases.h"

#include <algorithm>

#include "deploy/runtime/files/file_error.h"
#include "engine_sim/deck/deck_columns.h"

namespace ehm::engine_sim {
namespace {

using files::CsvRow;
using files::CsvTable;
using files::FileError;
using files::in_quotes;

std::string names_of(bool (*chosen)(const DeckInput&)) {
  std::string names;
  for (const DeckInput& input : deck_inputs()) {
    if (chosen(input)) names += (names.empty() ? "" : ", ") + input.name;
  }
  return names;
}

/// The input of each column, in the order of the file.
std::vector<const DeckInput*> resolve(const CsvTable& table) {
  const std::vector<DeckInput>& inputs = deck_inputs();
  std::vector<const DeckInput*> columns;
  for (const std::string& name : table.header.cells) {
    const auto found = std::find_if(inputs.begin(), inputs.end(), [&](const DeckInput& i) { return i.name == name; });
    if (found == inputs.end())
      throw FileError(table.place(table.header) + ": unknown column " + in_quotes(name) + ", allowed are " +
                      names_of([](const DeckInput&) { return true; }));
    columns.push_back(&*found);
  }
  return columns;
}

void require_complete(const CsvTable& table) {
  std::string demands;
  int demand_count = 0;
  for (const DeckInput& input : deck_inputs()) {
    const bool present = table.column(input.name).has_value();
    if (input.required && !present)
      throw FileError(table.place(table.header) + ": column '" + input.name + "' is missing");
    if (!input.demand || !present) continue;
    ++demand_count;
    demands += (demands.empty() ? "'" : " and '") + input.name + "'";
  }
  if (demand_count != 1)
    throw FileError(table.place(table.header) + ": the demands are " + (demands.empty() ? "none" : demands) +
                    ", allowed is exactly one of " +
                    names_of([](const DeckInput& input) { return input.demand.has_value(); }));
}

double value_of(const CsvTable& table, const CsvRow& row, const DeckInput& input, const std::string& cell) {
  const auto value = files::parse_number(cell);
  if (value && *value >= input.lowest && *value <= input.highest) return *value;
  throw FileError(table.place(row) + ": '" + input.name + "' is " + in_quotes(cell) + ", allowed is a number from " +
                  files::shortest(input.lowest) + " to " + files::shortest(input.highest));
}

DeckCase read_case(const CsvTable& table, const CsvRow& row, const std::vector<const DeckInput*>& columns) {
  DeckCase out{row.line, {}, {}, {}};
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const DeckInput& input = *columns[i];
    const double value = value_of(table, row, input, row.cells[i]);
    if (input.demand) {
      out.demand = {*input.demand, value};
    } else {
      input.set(out.operation, value);
    }
    out.inputs += (i == 0 ? "" : ",") + row.cells[i];
  }
  return out;
}

}  // namespace

DeckCases read_deck_cases(const CsvTable& table) {
  const std::vector<const DeckInput*> columns = resolve(table);
  require_complete(table);
  DeckCases out{table.file, table.header.cells, {}};
  out.cases.reserve(table.rows.size());
  for (const CsvRow& row : table.rows) out.cases.push_back(read_case(table, row, columns));
  return out;
}

}  // namespace ehm::engine_sim
