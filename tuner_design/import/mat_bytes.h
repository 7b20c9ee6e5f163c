// SPDX-License-Identifier: Apache-2.0
#pragma once
// Numbers in a MATLAB file's order of bytes.

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace ehm::tuner_design {

/// The first `size` (2 or 4) bytes at `at`; the caller has checked that they are there.
inline std::uint32_t unsigned_at(std::string_view bytes, std::size_t at, std::size_t size, bool little_endian) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const auto byte = static_cast<unsigned char>(bytes[at + (little_endian ? size - 1 - i : i)]);
    value = value << 8U | byte;
  }
  return value;
}

}  // namespace ehm::tuner_design
