#pragma once
// Text for the wire: what a damaged file or a stranger brought along must not break a subscriber that expects text.

#include <algorithm>
#include <string>

namespace ehm::monitor {

/// Every byte that is not printable ASCII becomes '?'.
inline std::string printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

}  // namespace ehm::monitor
