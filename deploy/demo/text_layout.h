// SPDX-License-Identifier: Apache-2.0
#pragma once
// Text laid out for a terminal of so many columns. A column is a UTF-8 code point.

#include <string>
#include <string_view>
#include <vector>

namespace ehm::demo {

/// Narrower ones are laid out as this: numbers are never cut.
inline constexpr int least_columns = 40;

/// Lines of whole words, each ended by "\n"; from the second on they begin with `indent` blanks. A word that is longer
/// than a line is cut into several.
std::string wrapped(std::string_view text, int columns, int indent);

/// Lines of cells, the first line their heads, each ended by "\n". `alignment`: a letter a column, l or r. What is too
/// wide is narrowed in this order: gaps, the left-aligned cells from the longest on (with a '~' at their end), and at
/// last the end of the line.
std::string columns_text(const std::vector<std::vector<std::string>>& lines, std::string_view alignment, int columns);

}  // namespace ehm::demo
