// SPDX-License-Identifier: Apache-2.0
#include "deploy/demo/terminal_width.h"

#include <sys/ioctl.h>

#include <charconv>
#include <cstdlib>
#include <string_view>

namespace ehm::demo {

int terminal_width(int descriptor) {
  winsize size{};
  if (ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  constexpr int usual = 80;
  const char* variable = std::getenv("COLUMNS");
  if (variable == nullptr) return usual;
  const std::string_view text(variable);
  int columns = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), columns);
  return error == std::errc() && end == text.data() + text.size() && columns > 0 ? columns : usual;
}

}  // namespace ehm::demo
