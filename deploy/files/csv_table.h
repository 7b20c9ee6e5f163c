#pragma once
// A file of comma separated values with one header line, as text; who uses it knows what the cells mean.
// Quoting as in RFC 4180, but one record is one line. Tolerated: CRLF, a byte order mark, spaces around a cell, blank
// lines. Parsed by libcsv in its strict mode. Lines count from 1, as editors show them.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ehm::files {

struct CsvRow {
  std::size_t line;
  std::vector<std::string> cells;
};

struct CsvTable {
  std::string file;  ///< as messages name it
  CsvRow header;
  std::vector<CsvRow> rows;  ///< each with as many cells as the header

  std::optional<std::size_t> column(std::string_view name) const;
  /// "FILE:LINE"
  std::string place(const CsvRow& row) const { return file + ":" + std::to_string(row.line); }
};

/// `path`: "-" is the standard input.
/// @throws FileError if it cannot be read, has no header or no row, repeats a column, or a line has unbalanced quotes
///         or another number of cells than the header
CsvTable read_csv(const std::string& path);

/// The lines of a file without a header, blank ones left out; none if it is empty.
/// @throws FileError if it cannot be read, or a line has unbalanced quotes
std::vector<CsvRow> read_csv_records(const std::string& path);

/// The same for values that are separated by blanks or tabs, any number of them, without quoting.
/// @throws FileError if it cannot be read
std::vector<CsvRow> read_blank_records(const std::string& path);

/// The number that the whole text is, if it is a finite one.
std::optional<double> parse_number(std::string_view text);

/// The shortest text that reads back as the same number.
std::string shortest(double value);

/// A text as one cell, in quotes where it must be.
std::string csv_cell(std::string_view text);

/// A user's text as messages repeat it: in quotes, unprintable characters replaced, long text cut.
std::string in_quotes(std::string_view text);

}  // namespace ehm::files
