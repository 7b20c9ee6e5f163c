// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/report/page/html_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tuner_design/report/page/text.h"

namespace ehm::tuner_design::report {
namespace {

constexpr int digits = 4, most_decimals = 5;
constexpr int unlike = -1;  ///< decimals of a column that does not have its own

std::string unit_of(const std::string& column) {
  const std::size_t unit = column.rfind(" [");
  return unit == std::string::npos ? "" : column.substr(unit);
}

std::vector<double> sizes_of(const DataTable& table, std::size_t column) {
  std::vector<double> sizes;
  for (const auto& row : table.rows) {
    const auto* value = std::get_if<double>(&row[column]);
    if (value != nullptr && std::isfinite(*value) && *value != 0.0) sizes.push_back(std::abs(*value));
  }
  return sizes;
}

bool whole(const std::vector<double>& sizes) {
  return std::all_of(sizes.begin(), sizes.end(), [](double size) { return size == std::round(size); });
}

/// Decimals that give the median of the columns with this unit `digits` significant digits; none for whole numbers.
int decimals_of(const DataTable& table, std::size_t column) {
  if (table.columns[column] == "value") return unlike;
  if (whole(sizes_of(table, column))) return 0;
  std::vector<double> sizes;
  for (std::size_t j = 0; j < table.columns.size(); ++j) {
    if (unit_of(table.columns[j]) != unit_of(table.columns[column])) continue;
    const std::vector<double> more = sizes_of(table, j);
    if (!whole(more)) sizes.insert(sizes.end(), more.begin(), more.end());
  }
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return std::clamp(digits - 1 - static_cast<int>(std::floor(std::log10(*middle))), 0, most_decimals);
}

std::string cell_text(const Cell& cell, int decimals) {
  if (const auto* text = std::get_if<std::string>(&cell)) return escaped(*text);
  const double value = std::get<double>(cell);
  if (decimals == unlike) return escaped(number(value, digits + 1));
  const bool vanishes = value != 0.0 && std::abs(value) < 0.95 * std::pow(10.0, -decimals);
  if (!std::isfinite(value) || value == 0.0 || vanishes || std::abs(value) >= 1e6)
    return escaped(number(value, vanishes ? 2 : digits));
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  return text[0] == '-' ? "−" + text.substr(1) : text;
}

bool is_text(const DataTable& table, std::size_t column) {
  return std::any_of(table.rows.begin(), table.rows.end(),
                     [&](const auto& row) { return std::holds_alternative<std::string>(row[column]); });
}

std::string header_cell(const std::string& column, bool text) {
  const std::string unit = unit_of(column);
  std::string html = text ? "<th scope=\"col\">" : "<th scope=\"col\" class=\"number\">";
  html += escaped(column.substr(0, column.size() - unit.size()));
  if (!unit.empty()) html += "<br/><span class=\"unit\">" + escaped(unit.substr(2, unit.size() - 3)) + "</span>";
  return html + "</th>";
}

}  // namespace

std::string html_table(const DataTable& table, const std::string& caption, std::size_t totals) {
  std::vector<bool> text;
  std::vector<int> decimals;
  std::string html = "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"" + escaped(caption) +
                     "\"><table><caption>" + escaped(caption) + "</caption><thead><tr>";
  for (std::size_t j = 0; j < table.columns.size(); ++j) {
    text.push_back(is_text(table, j));
    decimals.push_back(decimals_of(table, j));
    html += header_cell(table.columns[j], text[j]);
  }
  html += "</tr></thead><tbody>";
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    html += i + totals >= table.rows.size() ? "<tr class=\"total\">" : "<tr>";
    for (std::size_t j = 0; j < table.columns.size(); ++j) {
      const std::string content = cell_text(table.rows[i][j], decimals[j]);
      if (j == 0) {
        html += "<th scope=\"row\">" + content + "</th>";
      } else {
        html += (text[j] ? "<td>" : "<td class=\"number\">") + content + "</td>";
      }
    }
    html += "</tr>";
  }
  return html + "</tbody></table></div>";
}

}  // namespace ehm::tuner_design::report
