// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/report/page/data_table.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>

#include "deploy/runtime/files/csv_table.h"

namespace ehm::tuner_design::report {
namespace {

std::string quoted(std::string text) {
  bool needs_quotes = text.empty();
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20U) c = ' ';
    needs_quotes = needs_quotes || c == ',' || c == '"' || c == ' ';
  }
  if (!needs_quotes) return text;
  for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2) text.insert(at, 1, '"');
  return '"' + text + '"';
}

std::string cell_text(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return quoted(*text);
  const double value = std::get<double>(cell);
  return std::isfinite(value) ? files::shortest(value) : "";
}

}  // namespace

std::string to_csv(const DataTable& table) {
  std::string csv;
  for (std::size_t j = 0; j < table.columns.size(); ++j) csv += (j == 0 ? "" : ",") + quoted(table.columns[j]);
  csv += '\n';
  for (const std::vector<Cell>& row : table.rows) {
    for (std::size_t j = 0; j < row.size(); ++j) csv += (j == 0 ? "" : ",") + cell_text(row[j]);
    csv += '\n';
  }
  return csv;
}

nlohmann::ordered_json to_json(const DataTable& table) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const std::vector<Cell>& cells : table.rows) {
    nlohmann::ordered_json row = nlohmann::ordered_json::array();
    for (const Cell& cell : cells) std::visit([&](const auto& value) { row.emplace_back(value); }, cell);
    rows.push_back(std::move(row));
  }
  return {{"columns", table.columns}, {"rows", std::move(rows)}};
}

std::string csv_link(const DataTable& table) {
  std::string link = "data:text/csv;charset=utf-8,";
  for (const char c : to_csv(table)) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = std::isalnum(byte) != 0 || c == '.' || c == '-' || c == '_' || c == ',';
    link += plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return link;
}

}  // namespace ehm::tuner_design::report
