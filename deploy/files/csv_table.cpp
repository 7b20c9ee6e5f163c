#include "deploy/files/csv_table.h"

#include <csv.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>
#include <new>
#include <sstream>

#include "deploy/files/file_error.h"

namespace ehm::files {
namespace {

/// libcsv, one line at a time, so that every cell has the number of its line.
class LineParser {
 public:
  LineParser() {
    if (csv_init(&parser_, CSV_STRICT | CSV_STRICT_FINI) != 0) throw std::bad_alloc();
  }
  ~LineParser() { csv_free(&parser_); }
  LineParser(const LineParser&) = delete;
  LineParser& operator=(const LineParser&) = delete;

  /// Cells of the line, none if it is blank. @throws FileError
  std::vector<std::string> parse(const std::string& line, const std::string& place) {
    Record record;
    const std::size_t done = csv_parse(&parser_, line.data(), line.size(), on_cell, on_end, &record);
    if (done != line.size() || csv_fini(&parser_, on_cell, on_end, &record) != 0)
      throw FileError(place + ": quotes do not match: " + in_quotes(line));
    if (record.ends > 1) throw FileError(place + ": carriage return within the line: " + in_quotes(line));
    return std::move(record.cells);
  }

 private:
  struct Record {
    std::vector<std::string> cells;
    int ends = 0;
  };
  static void on_cell(void* text, std::size_t length, void* record) {
    static_cast<Record*>(record)->cells.emplace_back(static_cast<const char*>(text), length);
  }
  static void on_end(int, void* record) { ++static_cast<Record*>(record)->ends; }

  csv_parser parser_;
};

void skip_byte_order_mark(std::string& line) {
  if (line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
}

void require_distinct(const CsvTable& table) {
  const auto& names = table.header.cells;
  for (auto name = names.begin(); name != names.end(); ++name) {
    if (std::find(names.begin(), name, *name) != name)
      throw FileError(table.place(table.header) + ": column " + in_quotes(*name) + " appears twice");
  }
}

std::vector<CsvRow> parse_records(std::istream& in, const std::string& file) {
  std::vector<CsvRow> records;
  LineParser parser;
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    if (++number == 1) skip_byte_order_mark(line);
    CsvRow row{number, parser.parse(line, file + ":" + std::to_string(number))};
    if (!row.cells.empty()) records.push_back(std::move(row));
  }
  if (in.bad()) throw FileError(file + ": cannot be read: " + std::strerror(errno));
  return records;
}

CsvTable parse_table(std::istream& in, const std::string& file) {
  std::vector<CsvRow> records = parse_records(in, file);
  if (records.empty()) throw FileError(file + ": is empty; its first line is to name the columns");
  CsvTable table{file, std::move(records.front()), {}};
  require_distinct(table);
  records.erase(records.begin());
  table.rows = std::move(records);
  if (table.rows.empty()) throw FileError(file + ": has no row below its header");
  for (const CsvRow& row : table.rows) {
    if (row.cells.size() != table.header.cells.size())
      throw FileError(table.place(row) + ": " + std::to_string(row.cells.size()) + " cells, allowed is " +
                      std::to_string(table.header.cells.size()) + ", as many as the header has");
  }
  return table;
}

std::ifstream open_to_read(const std::string& path) {
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  // peek() finds out what opening does not tell: a folder opens, but cannot be read
  if (!in || (in.peek(), in.bad())) throw FileError(path + ": cannot be read: " + std::strerror(errno));
  in.clear();
  return in;
}

}  // namespace

std::optional<std::size_t> CsvTable::column(std::string_view name) const {
  const auto found = std::find(header.cells.begin(), header.cells.end(), name);
  if (found == header.cells.end()) return std::nullopt;
  return static_cast<std::size_t>(found - header.cells.begin());
}

CsvTable read_csv(const std::string& path) {
  if (path == "-") return parse_table(std::cin, "standard input");
  std::ifstream in = open_to_read(path);
  return parse_table(in, path);
}

std::vector<CsvRow> read_csv_records(const std::string& path) {
  std::ifstream in = open_to_read(path);
  return parse_records(in, path);
}

std::vector<CsvRow> read_blank_records(const std::string& path) {
  std::ifstream in = open_to_read(path);
  std::vector<CsvRow> records;
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    if (++number == 1) skip_byte_order_mark(line);
    std::istringstream cells(line);
    CsvRow row{number, {std::istream_iterator<std::string>(cells), {}}};
    if (!row.cells.empty()) records.push_back(std::move(row));
  }
  if (in.bad()) throw FileError(path + ": cannot be read: " + std::strerror(errno));
  return records;
}

std::optional<double> parse_number(std::string_view text) {
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
