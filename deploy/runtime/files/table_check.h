// SPDX-License-Identifier: Apache-2.0
#pragma once
// Is a table whole? The one check that every reader of tables makes: each row has as many cells as the header, or as
// the first row where there is none; and a last line that nothing ends shows that it is whole.
//
// A file that was cut within its last number has the right number of cells, and only the missing end of its last line
// tells. RFC 4180 leaves that end free, so such a line is taken if its last cell has its decimals, as the cells above
// it have:
//
//   with a point          as many decimals as any cell above has at least, and one
//   without               no cell above has a point, and none is longer
//   with an exponent      all above have one, none with fewer digits
//   empty                 all above are
//
// What is missing then is less than the last decimal that this column is written with. Where nothing stands above, or
// text, the line is taken.

#include <cstddef>
#include <string>
#include <vector>

namespace ehm::files {

enum class Separator { comma, semicolon, tab, blank };  ///< blank: blanks and tabs, any number, without quoting

struct TableFormat {
  Separator separator = Separator::comma;
  bool header = false;         ///< the first line names the columns
  bool decimal_comma = false;  ///< 0,5 is a half
  /// Cells of one column are alike, so that those above tell whether the last one is whole.
  bool columns_alike = true;
};

struct CsvRow {
  std::size_t line;  ///< from 1, as editors show them
  std::vector<std::string> cells;
};

struct ReadRows {
  std::string file;  ///< as messages name it
  TableFormat format;
  std::vector<CsvRow> rows;     ///< the header among them
  bool ends_in_a_cell = false;  ///< nothing stands behind the last cell: no newline, blank or quote
};

/// @throws FileError with file, line, the number of cells expected and found, and the likely cause
void require_whole(const ReadRows& table);

/// A cell that is the decimals of the cell before it, or what follows a comma for thousands: a number with a leading
/// zero, behind a whole number. Tells tables whose numbers were torn apart, where every row was.
bool is_torn_off(const CsvRow& row, std::size_t column);

}  // namespace ehm::files
