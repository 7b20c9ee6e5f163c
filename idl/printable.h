// SPDX-License-Identifier: Apache-2.0
#pragma once
// Text of strangers, and text for the wire: what a damaged file or another participant brought along must neither forge
// lines of a log, steer a terminal, nor break JSON.

#include <cstddef>
#include <string>
#include <string_view>

namespace ehm::idl {

/// Length of the UTF-8 character that begins at `i`; 0 if none does, or if it is a control character (C0, DEL, C1).
inline std::size_t printable_length(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned first = byte(i);
  if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : 0;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || i + length > text.size()) return 0;
  unsigned code = first & (0xffu >> (length + 1));
  for (std::size_t k = 1; k < length; ++k) {
    if ((byte(i + k) & 0xc0u) != 0x80u) return 0;
    code = code << 6 | (byte(i + k) & 0x3fu);
  }
  const bool overlong = code < (length == 2 ? 0x80u : length == 3 ? 0x800u : 0x10000u);
  const bool surrogate = code >= 0xd800 && code <= 0xdfff;
  // Beyond C1 also what reorders or separates lines where it is shown.
  const bool steers = code < 0xa0 || (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
  return overlong || surrogate || code > 0x10ffff || steers ? 0 : length;
}

/// Every byte that is no part of a printable UTF-8 character becomes '?'.
inline std::string printable(std::string text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = printable_length(text, i);
    if (length == 0) text[i] = '?';
    i += length == 0 ? 1 : length;
  }
  return text;
}

}  // namespace ehm::idl
