// SPDX-License-Identifier: Apache-2.0
#pragma once
// The text of a table as lines, whatever system wrote it: lines end in LF, CR LF or CR, a byte order mark of UTF-8 is
// passed over. What is no text is named as what it is.

#include <string>
#include <string_view>

namespace ehm::files {

/// All of a file; "-" is the standard input.
/// @throws FileError if it cannot be read
std::string read_text(const std::string& path);

class TableLines {
 public:
  /// `text` must outlive this. @throws FileError naming `file` if the text is UTF-16 or UTF-32, or holds a NUL byte
  TableLines(std::string_view text, const std::string& file);

  /// The next line without its end; false when there is none.
  bool next(std::string_view& line);
  /// Of the line that came last, from 1.
  std::size_t number() const { return number_; }
  /// The line that came last is the file's last one, and nothing ends it.
  bool open_end() const { return open_end_; }

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
  bool open_end_ = false;
};

}  // namespace ehm::files
