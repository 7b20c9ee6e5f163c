// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/import/mat_element.h"

#include <array>
#include <cstdint>
#include <optional>

#include "tuner_design/import/mat_reader.h"

namespace ehm::tuner_design {
namespace {

using namespace mat;
constexpr std::uint32_t complex_flag = 0x0800;
constexpr int most_depth = 64;

/// Bytes of one number or character by its type, 0 for what holds none.
std::size_t size_of_type(std::uint32_t type) {
  constexpr std::array<std::size_t, 19> sizes{0, 1, 1, 2, 2, 4, 4, 4, 0, 8, 0, 0, 8, 8, 0, 0, 1, 2, 4};
  return type < sizes.size() ? sizes[type] : 0;
}

/// `count` numbers, as one element.
bool holds_numbers(Reader& reader, std::uint64_t count) {
  const auto element = reader.next();
  if (!element) return false;
  const std::size_t size = size_of_type(element->type);
  return size > 0 && element->data.size() / size >= count;
}

/// `count` arrays.
bool holds_arrays(Reader& reader, std::uint64_t count, int depth) {
  if (count > reader.left() / 8) return false;
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto element = reader.next();
    if (!element || element->type != mi_matrix) return false;
    if (!is_sound_array(element->data, reader.little_endian(), depth + 1)) return false;
  }
  return true;
}

/// Names of the fields in a row, each as long, then the fields of each element.
bool holds_fields(Reader& reader, std::uint64_t count, int depth) {
  const auto length = reader.next();
  if (!length || length->type != mi_int32 || length->data.size() < 4) return false;
  const std::uint32_t width = reader.word(length->data, 0);
  const auto names = reader.next();
  if (!names || width == 0 || names->data.size() % width != 0) return false;
  const std::size_t fields = names->data.size() / width;
  for (std::size_t i = 0; i < fields; ++i) {  // each ends with a zero
    if (names->data.substr(i * width, width).find('\0') == std::string_view::npos) return false;
  }
  return count <= reader.left() && holds_arrays(reader, count * fields, depth);
}

/// Number of entries. Nothing if the dimensions are none, negative, or have a product beyond any file.
std::optional<std::uint64_t> entries(const Reader& reader, const Element& dimensions) {
  const std::size_t rank = dimensions.data.size() / 4;
  if (dimensions.type != mi_int32 || rank < 2 || rank > 32) return std::nullopt;
  std::uint64_t count = 1;
  for (std::size_t i = 0; i < rank; ++i) {
    const std::uint32_t size = reader.word(dimensions.data, i);
    if (size > 0x7fffffffU || count > 0xffffffffU) return std::nullopt;
    count *= size;
  }
  return count;
}

bool holds_sparse(Reader& reader, std::uint64_t columns, bool complex) {
  return holds_numbers(reader, 0) && holds_numbers(reader, columns + 1) && holds_numbers(reader, 0) &&
         (!complex || holds_numbers(reader, 0));
}

}  // namespace

bool is_sound_array(std::string_view content, bool little_endian, int depth) {
  if (content.empty()) return true;  // an empty cell
  if (depth > most_depth) return false;
  Reader reader(content, little_endian);
  const auto flags = reader.next();
  if (!flags || flags->type != mi_uint32 || flags->data.size() != 8) return false;
  const std::uint32_t type = reader.word(flags->data, 0) & 0xffU;
  const bool complex = (reader.word(flags->data, 0) & complex_flag) != 0;
  if (type == class_opaque) return true;  // MATLAB's own, of which libmatio reads no more than this
  const auto dimensions = reader.next();
  const auto name = dimensions ? reader.next() : std::nullopt;
  if (!name) return false;
  const auto count = entries(reader, *dimensions);
  if (!count) return false;
  if (type == class_cell || type == class_function) return holds_arrays(reader, *count, depth);
  if (type == class_struct) return holds_fields(reader, *count, depth);
  if (type == class_object) return reader.next().has_value() && holds_fields(reader, *count, depth);
  if (type == class_sparse) return holds_sparse(reader, reader.word(dimensions->data, 1), complex);
  return type >= class_char && type <= class_uint64 && holds_numbers(reader, *count) &&
         (!complex || holds_numbers(reader, *count));
}

}  // namespace ehm::tuner_design
