// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/import/mat_object.h"

#include <algorithm>
#include <array>
#include <utility>

#include "deploy/runtime/numbers/index.h"
#include "tuner_design/import/mat_reader.h"

namespace ehm::tuner_design {
namespace {

using namespace mat;

constexpr std::size_t zeros_begin = 48;  ///< flags 16, dimensions 16, empty name 8, tag of the data 8

std::string text_of(const std::optional<Element>& element) {
  return element ? std::string(element->data.substr(0, element->data.find('\0'))) : std::string();
}

void put(std::string& image, std::size_t at, std::uint32_t value, bool little_endian) {
  for (std::size_t i = 0; i < 4; ++i)
    image[at + i] = static_cast<char>(value >> 8U * (little_endian ? i : 3 - i) & 0xffU);
}

/// An array of uint8 zeros in the same bytes.
void make_zeros(std::string& image, std::size_t begin, std::size_t size, bool little_endian) {
  std::fill_n(image.begin() + static_cast<std::ptrdiff_t>(begin), size, '\0');
  const auto count = static_cast<std::uint32_t>((size - zeros_begin) / 8 * 8);
  const std::array<std::uint32_t, 12> words{mi_uint32, 8,     class_uint8, 0, mi_int32, 8,
                                            1,         count, mi_int8,     0, mi_uint8, count};
  for (std::size_t i = 0; i < words.size(); ++i) put(image, begin + 4 * i, words[i], little_endian);
}

/// Walks the arrays within an array.
class Hider {
 public:
  Hider(std::string& image, bool little_endian) : image_(image), little_endian_(little_endian) {}

  void walk(std::size_t begin, std::size_t size, const std::string& name) {
    Reader reader(std::string_view(image_).substr(begin, size), little_endian_);
    const auto flags = reader.next();
    if (!flags || flags->data.size() < 4) return;
    const std::uint32_t type = reader.word(flags->data, 0) & 0xffU;
    if (type != class_cell && type != class_struct) return;
    reader.next();  // dimensions
    const std::string own = text_of(reader.next());
    std::vector<std::string> fields{""};
    if (type == class_struct) fields = field_names(reader);
    const std::string path = name.empty() ? own : name;
    for (std::size_t i = 0; !fields.empty(); ++i) {
      const auto element = reader.next();
      if (!element) return;
      const std::string& field = fields[i % fields.size()];
      const auto at = as_size(element->data.data() - image_.data());
      visit(at, element->data.size(), field.empty() ? path : path + "." + field);
    }
  }
  std::vector<MatObject> found;

 private:
  static std::vector<std::string> field_names(Reader& reader) {
    const auto length = reader.next();
    const auto names = reader.next();
    std::vector<std::string> fields;
    if (!length || !names || length->data.size() < 4) return fields;
    const std::size_t width = reader.word(length->data, 0);
    for (std::size_t at = 0; width > 0 && at + width <= names->data.size(); at += width)
      fields.push_back(text_of(Element{mi_int8, names->data.substr(at, width)}));
    return fields;
  }
  void visit(std::size_t begin, std::size_t size, const std::string& name) {
    if (const auto object = object_in(std::string_view(image_).substr(begin, size), little_endian_)) {
      found.push_back({name, object->class_name});
      if (size >= zeros_begin) make_zeros(image_, begin, size, little_endian_);
    } else {
      walk(begin, size, name);
    }
  }

  std::string& image_;
  bool little_endian_;
};

}  // namespace

std::optional<MatObject> object_in(std::string_view array, bool little_endian) {
  Reader reader(array, little_endian);
  const auto flags = reader.next();
  if (!flags || flags->data.size() < 4) return std::nullopt;
  const std::uint32_t type = reader.word(flags->data, 0) & 0xffU;
  if (type != class_opaque && type != class_object) return std::nullopt;
  if (type == class_object) reader.next();  // dimensions
  std::string name = text_of(reader.next());
  if (type == class_opaque) reader.next();  // "MCOS"
  return MatObject{std::move(name), text_of(reader.next())};
}

std::vector<MatObject> hide_objects(std::string& image, std::size_t array_begin, bool little_endian) {
  Hider hider(image, little_endian);
  hider.walk(array_begin, image.size() - array_begin, "");
  return std::move(hider.found);
}

bool is_system(const MatObject& object) {
  constexpr std::array systems{"ss", "tf", "zpk", "idss", "idtf", "idgrey", "genss", "sparss", "mechss"};
  return std::find(systems.begin(), systems.end(), object.class_name) != systems.end();
}

std::string saved_otherwise(const MatObject& object) {
  const std::string x = object.name.substr(object.name.rfind('.') + 1);
  if (is_system(object)) return "Save its matrices: [A, B, C, D] = ssdata(" + x + ")";
  constexpr std::array<std::pair<const char*, const char*>, 8> ways{{{"string", "cellstr"},
                                                                     {"categorical", "cellstr"},
                                                                     {"table", "table2array"},
                                                                     {"gpuArray", "gather"},
                                                                     {"dlarray", "extractdata"},
                                                                     {"sym", "double"},
                                                                     {"fi", "double"},
                                                                     {"duration", "seconds"}}};
  for (const auto& [class_name, function] : ways)
    if (object.class_name == class_name) return "Save it as " + x + " = " + function + "(" + x + ")";
  if (object.class_name == "timeseries") return "Save it as " + x + " = " + x + ".Data";
  return "Save what it holds as a matrix of numbers, or as a cell array of texts";
}

}  // namespace ehm::tuner_design
