// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/files/table_check.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <string_view>

#include "deploy/runtime/files/csv_table.h"
#include "deploy/runtime/files/file_error.h"

namespace ehm::files {
namespace {

bool all_digits(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c); });
}

/// A whole number with or without a sign: its digits, else nothing.
std::string_view whole_number(std::string_view text) {
  if (!text.empty() && (text[0] == '-' || text[0] == '+')) text.remove_prefix(1);
  return all_digits(text) ? text : std::string_view();
}

/// 752 and 747.5: what a comma or blank for thousands makes of a number.
bool thousands(const std::vector<std::string>& cells) {
  for (std::size_t i = 1; i < cells.size(); ++i) {
    const std::string_view before = whole_number(cells[i - 1]);
    const std::string_view head = std::string_view(cells[i]).substr(0, cells[i].find('.'));
    if (!before.empty() && before.size() <= 3 && before[0] != '0' && head.size() == 3 && all_digits(head)) return true;
  }
  return false;
}

bool any_has(const std::vector<std::string>& cells, char c) {
  return std::any_of(cells.begin(), cells.end(),
                     [c](const std::string& cell) { return cell.find(c) != std::string::npos; });
}

bool any_number_with_point(const std::vector<std::string>& cells) {
  return std::any_of(cells.begin(), cells.end(),
                     [](const std::string& cell) { return cell.find('.') != cell.npos && parse_number(cell); });
}

/// 0 and 824: what a decimal comma makes of a number.
bool torn_anywhere(const std::vector<std::string>& cells) {
  for (std::size_t i = 1; i < cells.size(); ++i)
    if (!whole_number(cells[i - 1]).empty() && all_digits(cells[i])) return !cells.back().empty();
  return false;
}

std::string torn_numbers(const CsvRow& row, std::size_t expected) {
  const std::string decimal_comma =
      "a decimal comma; write points, or separate the cells by semicolons and quote nothing (a column map then says "
      "separator = \"semicolon\", decimal = \"comma\")";
  const bool points = any_number_with_point(row.cells);
  if (!points && row.cells.size() > expected + 1) return decimal_comma;
  if (!points && !thousands(row.cells) && torn_anywhere(row.cells)) return decimal_comma + ", or a cell too many";
  if (!thousands(row.cells)) return "";
  const std::string in_thousands = "a comma for thousands; write numbers without it";
  return points ? in_thousands : in_thousands + ", or " + decimal_comma;
}

/// The separator that the line seems to have instead.
std::string another_separator(const std::vector<std::string>& cells, Separator separator) {
  if (separator != Separator::semicolon && any_has(cells, ';')) return "semicolon";
  if (separator != Separator::tab && separator != Separator::blank && any_has(cells, '\t')) return "tab";
  if (separator != Separator::comma && any_has(cells, ',')) return "comma";
  return separator != Separator::blank && cells.size() == 1 && any_has(cells, ' ') ? "blank" : "";
}

std::string too_many(const ReadRows& table, const CsvRow& row, std::size_t expected) {
  const TableFormat& format = table.format;
  if (format.separator == Separator::comma) {
    if (any_has(row.cells, ';')) return "semicolons between the cells, and decimal commas in them";
    if (const std::string torn = torn_numbers(row, expected); !torn.empty()) return torn;
  }
  if (format.separator == Separator::blank)
    return thousands(row.cells) ? "a blank for thousands" : "a blank within a text; write none";
  if (row.cells.back().empty()) return "a separator at the line's end";
  return "a text with a separator in it; put it in quotes";
}

std::string too_few(const ReadRows& table, const CsvRow& row) {
  const bool last = &row == &table.rows.back();
  if (last && table.ends_in_a_cell) return "the file ends within this line: it was cut off, or is still being written";
  if (row.cells.front().starts_with('#')) return "a comment, which a table has none of";
  if (const std::string other = another_separator(row.cells, table.format.separator); !other.empty())
    return "another separator, " + other;
  const std::string cut_off = last ? ", or the file was cut off here" : "";
  if (table.format.separator == Separator::blank)
    return "a missing cell" + cut_off +
           "; where blanks separate, what follows it slides: write nan for a missing value, or separate by tabs or "
           "commas";
  return "a missing cell" + cut_off + "; an empty one needs its separator";
}

/// Most rows are as long as this one: it is the first line that is not as the others are.
std::string odd_first_line(const ReadRows& table, const CsvRow& row, std::size_t expected) {
  const bool header = table.format.header, more = row.cells.size() > expected;
  if (!header) return "the first line is not as the others are: a title, a header, or a cell too many or too few";
  if (!more)
    return table.format.separator == Separator::blank ? "a name in the header has a blank in it; write it without"
                                                      : "a name in the header has a separator in it, or each row "
                                                        "lacks a cell";
  if (row.cells.back().empty()) return "a separator at the end of each row that the header does not have";
  return table.format.separator == Separator::blank || row.cells.size() > expected + 1
             ? "names are missing in the header"
             : "each row begins with a number that the header does not name, or a name is missing there";
}

std::string likely_cause(const ReadRows& table, const CsvRow& row, std::size_t expected) {
  const auto as_long = std::count_if(table.rows.begin() + 1, table.rows.end(),
                                     [&](const CsvRow& r) { return r.cells.size() == row.cells.size(); });
  const bool more = row.cells.size() > expected;
  if (more && table.format.separator == Separator::comma) {
    if (const std::string torn = torn_numbers(row, expected); !torn.empty() || any_has(row.cells, ';'))
      return too_many(table, row, expected);
  }
  // The rows below agree with each other from the first one on, and most of them.
  if (&row == &table.rows[1] && as_long > 1 && 2 * static_cast<std::size_t>(as_long) >= table.rows.size() - 1 &&
      another_separator(row.cells, table.format.separator).empty())
    return odd_first_line(table, row, expected);
  return more ? too_many(table, row, expected) : too_few(table, row);
}

struct NumberShape {
  std::size_t length = 0, decimals = 0, exponent_digits = 0;
  bool point = false, exponent = false;
};

NumberShape shape_of(std::string_view cell, char decimal) {
  NumberShape shape;
  shape.length = cell.size();
  const std::size_t e = cell.find_first_of("eE"), point = cell.find(decimal);
  shape.exponent = e != cell.npos;
  shape.point = point != cell.npos;
  const std::string_view tail = shape.exponent ? cell.substr(e + 1) : std::string_view();
  shape.exponent_digits = static_cast<std::size_t>(
      std::count_if(tail.begin(), tail.end(), [](unsigned char c) { return std::isdigit(c); }));
  if (shape.point) shape.decimals = std::min(e, cell.size()) - point - 1;
  return shape;
}

/// As the header of this file says; `others` are the numbers above.
bool shows_its_end(const NumberShape& cell, const std::vector<NumberShape>& others) {
  const auto all = [&](auto&& holds) { return std::all_of(others.begin(), others.end(), holds); };
  const auto any_exponent = [](const NumberShape& o) { return o.exponent; };
  if (cell.exponent || std::any_of(others.begin(), others.end(), any_exponent))
    return cell.exponent && all([&](const NumberShape& o) {
             return o.exponent && cell.exponent_digits >= std::max<std::size_t>(1, o.exponent_digits);
           });
  if (!cell.point) return all([&](const NumberShape& o) { return !o.point && o.length <= cell.length; });
  std::size_t least = others.front().decimals;
  for (const NumberShape& o : others) least = std::min(least, o.decimals);
  return cell.decimals >= std::max<std::size_t>(1, least);
}

[[noreturn]] void refuse_cut_off(const ReadRows& table, const std::string& above) {
  const CsvRow& row = table.rows.back();
  throw FileError(table.file + ":" + std::to_string(row.line) + ": the last line has no newline at its end, and its " +
                  "last cell is " + in_quotes(row.cells.back()) + " where others are as " + in_quotes(above) +
                  ". Likely cause: the file was cut off, or is still being written; if it is whole, end it with a "
                  "newline, else delete the line");
}

void require_end(const ReadRows& table) {
  const std::size_t first = table.format.header ? 1 : 0;
  if (!table.ends_in_a_cell || !table.format.columns_alike || table.rows.size() <= first + 1) return;
  const char decimal = table.format.decimal_comma ? ',' : '.';
  const std::string& cell = table.rows.back().cells.back();
  std::vector<NumberShape> others;
  const std::string* filled = nullptr;
  for (std::size_t i = first; i + 1 < table.rows.size(); ++i) {
    const std::string& above = table.rows[i].cells.back();
    if (above.empty()) continue;
    filled = &above;
    if (parse_number(above, decimal)) others.push_back(shape_of(above, decimal));
  }
  if (cell.empty() && filled) refuse_cut_off(table, *filled);
  if (others.empty() || !parse_number(cell, decimal)) return;
  if (!shows_its_end(shape_of(cell, decimal), others)) refuse_cut_off(table, *filled);
}

}  // namespace

void require_whole(const ReadRows& table) {
  if (table.rows.empty()) return;
  const std::size_t expected = table.rows.front().cells.size();
  for (const CsvRow& row : table.rows) {
    if (row.cells.size() == expected) continue;
    throw FileError(table.file + ":" + std::to_string(row.line) + ": " + std::to_string(row.cells.size()) +
                    " cells found, " + std::to_string(expected) + " expected, as many as the " +
                    (table.format.header ? "header" : "first row") +
                    " has. Likely cause: " + likely_cause(table, row, expected));
  }
  require_end(table);
}

bool is_torn_off(const CsvRow& row, std::size_t column) {
  if (column == 0 || whole_number(row.cells[column - 1]).empty()) return false;
  const std::string_view cell = row.cells[column];
  return cell.size() > 1 && cell[0] == '0' && std::isdigit(static_cast<unsigned char>(cell[1])) &&
         parse_number(cell).has_value();
}

}  // namespace ehm::files
