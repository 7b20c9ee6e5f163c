// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/files/csv_table.h"

#include <csv.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <new>

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/files/table_text.h"

namespace ehm::files {
namespace {

char letter(Separator separator) {
  return separator == Separator::semicolon ? ';' : separator == Separator::tab ? '\t' : ',';
}

/// libcsv, one line at a time, so that every cell has the number of its line.
class LineParser {
 public:
  explicit LineParser(Separator separator) {
    if (csv_init(&parser_, CSV_STRICT | CSV_STRICT_FINI) != 0) throw std::bad_alloc();
    csv_set_delim(&parser_, static_cast<unsigned char>(letter(separator)));
  }
  ~LineParser() { csv_free(&parser_); }
  LineParser(const LineParser&) = delete;
  LineParser& operator=(const LineParser&) = delete;

  /// Cells of the line, none if it is blank. False where quotes do not match.
  bool parse(std::string_view line, std::vector<std::string>& cells) {
    return csv_parse(&parser_, line.data(), line.size(), on_cell, on_end, &cells) == line.size() &&
           csv_fini(&parser_, on_cell, on_end, &cells) == 0;
  }

 private:
  static void on_cell(void* text, std::size_t length, void* cells) {
    static_cast<std::vector<std::string>*>(cells)->emplace_back(static_cast<const char*>(text), length);
  }
  static void on_end(int, void*) {}

  csv_parser parser_;
};

std::vector<std::string> blank_separated(std::string_view line) {
  constexpr std::string_view blanks = " \t\f\v";
  std::vector<std::string> cells;
  for (std::size_t end = 0; (end = line.find_first_not_of(blanks, end)) != line.npos;) {
    const std::size_t begin = end;
    end = std::min(line.find_first_of(blanks, begin), line.size());
    cells.emplace_back(line.substr(begin, end - begin));
  }
  return cells;
}

void require_distinct(const CsvTable& table) {
  const auto& names = table.header.cells;
  for (auto name = names.begin(); name != names.end(); ++name) {
    if (std::find(names.begin(), name, *name) != name)
      throw FileError(table.place(table.header) + ": column " + in_quotes(*name) + " appears twice");
  }
}

ReadRows read_rows(const std::string& path, const TableFormat& format) {
  const std::string text = read_text(path);
  ReadRows table{path == "-" ? "standard input" : path, format, {}, false};
  TableLines lines(text, table.file);
  LineParser parser(format.separator);
  for (std::string_view line; lines.next(line);) {
    CsvRow row{lines.number(), {}};
    if (format.separator == Separator::blank)
      row.cells = blank_separated(line);
    else if (!parser.parse(line, row.cells))
      throw FileError(table.file + ":" + std::to_string(row.line) + ": quotes do not match: " + in_quotes(line) +
                      (lines.open_end() ? "; the file ends within this line: was it cut off?" : ""));
    if (row.cells.empty()) continue;
    table.ends_in_a_cell = lines.open_end() && line.find_last_of("\" \t") != line.size() - 1;
    table.rows.push_back(std::move(row));
  }
  require_whole(table);
  return table;
}

}  // namespace

std::optional<std::size_t> CsvTable::column(std::string_view name) const {
  const auto found = std::find(header.cells.begin(), header.cells.end(), name);
  if (found == header.cells.end()) return std::nullopt;
  return static_cast<std::size_t>(found - header.cells.begin());
}

CsvTable read_csv(const std::string& path, bool columns_alike) {
  ReadRows read = read_rows(path, {Separator::comma, true, false, columns_alike});
  if (read.rows.empty()) throw FileError(read.file + ": is empty; its first line is to name the columns");
  CsvTable table{read.file, std::move(read.rows.front()), {}};
  require_distinct(table);
  table.rows.assign(std::make_move_iterator(read.rows.begin() + 1), std::make_move_iterator(read.rows.end()));
  if (table.rows.empty()) throw FileError(table.file + ": has no row below its header");
  return table;
}

std::vector<CsvRow> read_records(const std::string& path, const TableFormat& format) {
  return read_rows(path, format).rows;
}

std::optional<double> parse_number(std::string_view text, char decimal) {
  if (decimal != '.') {
    // A point beside decimal commas would be one for thousands, or a mistake.
    if (text.find('.') != text.npos) return std::nullopt;
    std::string with_point(text);
    std::replace(with_point.begin(), with_point.end(), decimal, '.');
    return parse_number(with_point);
  }
  // from_chars knows no plus sign, which people write before temperature offsets
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

std::string shortest(double value) {
  char text[32];  // the longest double has 24 characters
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string csv_cell(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + '"';
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::string out = "'";
  for (const char c : text.substr(0, longest)) out += c >= ' ' && c <= '~' ? c : '?';
  return out + (text.size() > longest ? "...'" : "'");
}

}  // namespace ehm::files
