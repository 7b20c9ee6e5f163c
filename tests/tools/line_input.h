// SPDX-License-Identifier: Apache-2.0
#pragma once
// Lines of standard input without waiting for them. The end of the input is no line: whoever reads goes on without.

#include <poll.h>
#include <unistd.h>

#include <optional>
#include <string>

namespace ehm::test {

class LineInput {
 public:
  /// The next complete line, if one is there.
  std::optional<std::string> next() {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    while (!ended_ && poll(&input, 1, 0) > 0) {
      char piece[512];
      const ssize_t size = read(STDIN_FILENO, piece, sizeof piece);
      if (size <= 0) ended_ = true;
      if (size > 0) text_.append(piece, static_cast<std::size_t>(size));
    }
    const std::size_t end = text_.find('\n');
    if (end == std::string::npos) return std::nullopt;
    const std::string line = text_.substr(0, end);
    text_.erase(0, end + 1);
    return line;
  }

 private:
  std::string text_;
  bool ended_ = false;
};

}  // namespace ehm::test
