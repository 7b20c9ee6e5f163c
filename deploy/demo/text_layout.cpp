// SPDX-License-Identifier: Apache-2.0
#include "deploy/demo/text_layout.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <numeric>

namespace ehm::demo {

namespace {

bool begins_a_code_point(char c) {
  return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u;
}

std::size_t width_of(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_a_code_point));
}

/// The first `width` code points.
std::string_view first_of(std::string_view text, std::size_t width) {
  std::size_t seen = 0;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (begins_a_code_point(text[i]) && seen++ == width) return text.substr(0, i);
  return text;
}

std::string cut(const std::string& text, std::size_t width) {
  return width_of(text) <= width ? text : std::string(first_of(text, width - 1)) + '~';
}

/// Widths of the columns that fit into `columns` together with gaps of `gap`; left-aligned cells give way.
void narrow(std::vector<std::size_t>& widths, std::string_view alignment, std::size_t gap, std::size_t columns) {
  constexpr std::size_t least = 4;
  const auto total = [&] { return std::accumulate(widths.begin(), widths.end(), gap * widths.size()); };
  while (total() > columns) {
    std::size_t widest = widths.size();
    for (std::size_t c = 0; c < widths.size(); ++c)
      if (alignment[c] == 'l' && (widest == widths.size() || widths[c] > widths[widest])) widest = c;
    if (widest == widths.size() || widths[widest] <= least) return;
    --widths[widest];
  }
}

}  // namespace

std::string wrapped(std::string_view text, int columns, int indent) {
  const auto most = static_cast<std::size_t>(std::max(columns, least_columns));
  const std::string margin(static_cast<std::size_t>(indent), ' ');
  std::string result, line;
  bool empty = true;  // no word on the line yet
  const auto end_line = [&] {
    result += line + '\n';
    line = margin;
    empty = true;
  };
  while (!text.empty() && text.front() == ' ') line += ' ', text.remove_prefix(1);
  while (!text.empty()) {
    const std::string_view word = text.substr(0, std::min(text.find(' '), text.size()));
    if (!empty && width_of(line) + 1 + width_of(word) > most) end_line();
    const std::string_view piece = first_of(word, most - width_of(line) - (empty ? 0 : 1));
    line.append(empty ? "" : " ").append(piece);
    empty = false;
    text.remove_prefix(piece.size());
    if (piece.size() < word.size()) end_line();
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  }
  return empty ? result : result + line + '\n';
}

std::string columns_text(const std::vector<std::vector<std::string>>& lines, std::string_view alignment, int columns) {
  const auto most = static_cast<std::size_t>(std::max(columns, least_columns));
  std::vector<std::size_t> widths(alignment.size());
  for (const auto& line : lines)
    for (std::size_t c = 0; c < line.size(); ++c) widths[c] = std::max(widths[c], width_of(line[c]));
  const std::size_t full = std::accumulate(widths.begin(), widths.end(), 2 * widths.size());
  const std::size_t gap = full > most ? 1 : 2;
  narrow(widths, alignment, gap, most);
  std::string text;
  for (const auto& cells : lines) {
    std::string line;
    for (std::size_t c = 0; c < cells.size(); ++c)
      line += std::string(gap, ' ') + (alignment[c] == 'l' ? fmt::format("{:<{}}", cut(cells[c], widths[c]), widths[c])
                                                           : fmt::format("{:>{}}", cells[c], widths[c]));
    line = line.substr(0, line.find_last_not_of(' ') + 1);
    text += std::string(first_of(line, most)) + '\n';
  }
  return text;
}

}  // namespace ehm::demo
