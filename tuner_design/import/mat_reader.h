// SPDX-License-Identifier: Apache-2.0
#pragma once
// The inner form of a MATLAB v5 array: elements {type u32, size u32, data padded to 8 bytes}, or, with at most four
// bytes of data, {type and size in one u32, data}. An array is its flags {class, ...}, dimensions, name, then what its
// class has; an object of a newer class (opaque) has none: flags, name, "MCOS", name of its class, a reference.
// Source: MathWorks, MAT-File Format, chapter 1; objects as files have them, since no document describes them.

#include <cstdint>
#include <optional>
#include <string_view>

#include "tuner_design/import/mat_bytes.h"

namespace ehm::tuner_design::mat {

inline constexpr std::uint32_t mi_int8 = 1, mi_uint8 = 2, mi_int32 = 5, mi_uint32 = 6, mi_matrix = 14;
inline constexpr std::uint32_t class_cell = 1, class_struct = 2, class_object = 3, class_char = 4, class_sparse = 5,
                               class_uint8 = 9, class_uint64 = 15, class_function = 16, class_opaque = 17;

struct Element {
  std::uint32_t type;
  std::string_view data;
};

/// The elements of an array, one after the other.
class Reader {
 public:
  Reader(std::string_view content, bool little_endian) : rest_(content), little_endian_(little_endian) {}

  /// Nothing if the content ends before the element does.
  std::optional<Element> next() {
    if (rest_.size() < 8) return std::nullopt;
    const std::uint32_t word = unsigned_at(rest_, 0, 4, little_endian_);
    if (word >> 16U != 0) {
      const std::size_t size = word >> 16U;
      if (size > 4) return std::nullopt;
      return take(word & 0xffffU, 4, size, 8);
    }
    const std::size_t size = unsigned_at(rest_, 4, 4, little_endian_);
    const std::size_t padded = word == mi_matrix ? size : (size + 7) / 8 * 8;
    return take(word, 8, size, 8 + padded);
  }
  std::size_t left() const { return rest_.size(); }
  std::uint32_t word(std::string_view data, std::size_t index) const {
    return unsigned_at(data, 4 * index, 4, little_endian_);
  }
  bool little_endian() const { return little_endian_; }

 private:
  std::optional<Element> take(std::uint32_t type, std::size_t start, std::size_t size, std::size_t total) {
    if (total > rest_.size()) return std::nullopt;
    const Element element{type, rest_.substr(start, size)};
    rest_.remove_prefix(total);
    return element;
  }

  std::string_view rest_;
  bool little_endian_;
};

}  // namespace ehm::tuner_design::mat
