// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/files/table_text.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iostream>
#include <iterator>

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/files/input_file.h"

namespace ehm::files {
namespace {

constexpr std::string_view utf8_mark = "\xEF\xBB\xBF";
constexpr const char* remedy =
    "; save it as UTF-8 (in a spreadsheet \"CSV UTF-8\", in a shell iconv -f UTF-16 -t UTF-8 IN > OUT)";

/// Two bytes a letter: every second one is NUL in a table's text.
bool every_second_is_nul(std::string_view text, std::size_t first) {
  const std::string_view head = text.substr(0, 64);
  std::size_t nuls = 0, places = 0;
  for (std::size_t i = first; i < head.size(); i += 2, ++places) nuls += head[i] == '\0';
  return places > 0 && 4 * nuls >= 3 * places;
}

void require_text(std::string_view text, const std::string& file) {
  using namespace std::string_view_literals;
  if (text.starts_with("\xFF\xFE\0\0"sv) || text.starts_with("\0\0\xFE\xFF"sv))
    throw FileError(file + ": is UTF-32" + remedy);
  if (text.starts_with("\xFF\xFE"sv) || text.starts_with("\xFE\xFF"sv)) throw FileError(file + ": is UTF-16" + remedy);
  const std::size_t nul = text.find('\0');
  if (nul == std::string_view::npos) return;
  if (every_second_is_nul(text, 0) || every_second_is_nul(text, 1))
    throw FileError(file + ": looks like UTF-16 without its byte order mark" + remedy);
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(nul), '\n');
  throw FileError(file + ":" + std::to_string(line) +
                  ": a NUL byte, which no text has; is it a table, or damaged by a loss of power?");
}

std::string content(std::istream& in, const std::string& file) {
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (in.bad()) throw FileError(file + ": cannot be read: " + std::strerror(errno));
  return text;
}

}  // namespace

std::string read_text(const std::string& path) {
  errno = 0;
  if (path == "-") return content(std::cin, "standard input");
  return read_input_file(path, table_file);
}

TableLines::TableLines(std::string_view text, const std::string& file) : rest_(text) {
  require_text(text, file);
  if (rest_.starts_with(utf8_mark)) rest_.remove_prefix(utf8_mark.size());
}

bool TableLines::next(std::string_view& line) {
  if (rest_.empty()) return false;
  ++number_;
  const std::size_t end = rest_.find_first_of("\r\n");
  line = rest_.substr(0, end);
  open_end_ = end == std::string_view::npos;
  if (open_end_)
    rest_ = {};
  else
    rest_.remove_prefix(end + (rest_.substr(end).starts_with("\r\n") ? 2 : 1));
  return true;
}

}  // namespace ehm::files
