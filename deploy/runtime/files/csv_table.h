// SPDX-License-Identifier: Apache-2.0
#pragma once
// A file of separated values as text; who uses it knows what the cells mean. Every row has as many cells as the header,
// or as the first row (table_check.h).
// Quoting as in RFC 4180, but one record is one line. Tolerated: lines that end in CR LF or CR, a byte order mark of
// UTF-8, spaces around a cell, blank lines. Parsed by libcsv in its strict mode. Lines count from 1, as editors show
// them.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deploy/runtime/files/table_check.h"

namespace ehm::files {

struct CsvTable {
  std::string file;  ///< as messages name it
  CsvRow header;
  std::vector<CsvRow> rows;

  std::optional<std::size_t> column(std::string_view name) const;
  /// "FILE:LINE"
  std::string place(const CsvRow& row) const { return file + ":" + std::to_string(row.line); }
};

/// Comma separated, with a header. `path`: "-" is the standard input.
/// @throws FileError if it cannot be read, has no header or no row, repeats a column, is no text, a line has unbalanced
///         quotes, or the table is not whole
CsvTable read_csv(const std::string& path, bool columns_alike = true);

/// The lines of a file, the header among them, blank ones left out; none if it is empty.
/// @throws FileError if it cannot be read, is no text, a line has unbalanced quotes, or the table is not whole
std::vector<CsvRow> read_records(const std::string& path, const TableFormat& format);

/// The number that the whole text is, if it is a finite one. `decimal`: point or comma.
std::optional<double> parse_number(std::string_view text, char decimal = '.');

/// The shortest text that reads back as the same number.
std::string shortest(double value);

/// A text as one cell, in quotes where it must be.
std::string csv_cell(std::string_view text);

/// A user's text as messages repeat it: in quotes, unprintable characters replaced, long text cut.
std::string in_quotes(std::string_view text);

}  // namespace ehm::files
