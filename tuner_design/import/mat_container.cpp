// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/import/mat_container.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string_view>

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/files/input_file.h"
#include "tuner_design/import/mat_bytes.h"
#include "tuner_design/import/mat_element.h"

namespace ehm::tuner_design {
namespace {

using files::FileError;

constexpr std::size_t header_size = 128, tag_size = 8, most_bytes = std::size_t{256} << 20U;
constexpr std::uint32_t mi_matrix = 14, mi_compressed = 15;

/// @returns true if the numbers are little endian.
bool check_header(std::string_view file, const std::string& path) {
  const bool complete = file.size() >= header_size;
  const std::string_view order = complete ? file.substr(126, 2) : "";
  const bool little = order == "IM";
  const std::uint32_t version = complete ? unsigned_at(file, 124, 2, little) : 0;
  if ((little || order == "MI") && version == 0x0100) return little;
  const bool hdf5 = file.starts_with("\x89HDF") || version == 0x0200;
  throw FileError(path + ": is " + (hdf5 ? "a MATLAB v7.3 (HDF5) file" : "no MATLAB v5 file") +
                  "; allowed: what save writes with -v6 or -v7. Save it again: save('engine.mat', 'A', ..., '-v7').");
}

[[noreturn]] void refuse_size(const std::string& path) {
  throw FileError(path + ": holds more than " + std::to_string(most_bytes >> 20U) +
                  " MB. Save only the variables of the model.");
}

/// Appends the inflated data. @returns false if they are not what zlib wrote.
bool inflate_into(std::string& out, std::string_view data, const std::string& path) {
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) throw std::runtime_error("zlib cannot start");
  const std::unique_ptr<z_stream, decltype(&inflateEnd)> guard(&stream, &inflateEnd);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data()));
  stream.avail_in = static_cast<uInt>(data.size());
  std::string block(std::size_t{1} << 16U, '\0');
  int status = Z_OK;
  while (status == Z_OK) {
    stream.next_out = reinterpret_cast<Bytef*>(block.data());
    stream.avail_out = static_cast<uInt>(block.size());
    status = inflate(&stream, Z_NO_FLUSH);
    out.append(block, 0, block.size() - stream.avail_out);
    if (out.size() > most_bytes) refuse_size(path);
  }
  return status == Z_STREAM_END;
}

/// A miMATRIX element as a whole.
bool is_sound_element(std::string_view element, bool little_endian) {
  return element.size() >= tag_size && unsigned_at(element, 0, 4, little_endian) == mi_matrix &&
         unsigned_at(element, 4, 4, little_endian) == element.size() - tag_size &&
         is_sound_array(element.substr(tag_size), little_endian);
}

}  // namespace

MatImage read_mat_image(const std::string& path) {
  const std::string file = files::read_input_file(path, files::matlab_file);
  const bool little_endian = check_header(file, path);
  if (file.size() > most_bytes) refuse_size(path);
  MatImage image{file.substr(0, header_size), 0, {}};
  std::fill_n(image.bytes.begin() + 116, 8, '\0');  // offset of MATLAB's own data, which have moved
  for (std::size_t at = header_size; at < file.size();) {
    const bool has_tag = file.size() - at >= tag_size;
    const std::uint32_t type = has_tag ? unsigned_at(file, at, 4, little_endian) : 0;
    const std::uint64_t size = has_tag ? tag_size + unsigned_at(file, at + 4, 4, little_endian) : 0;
    const std::size_t start = image.bytes.size();
    bool sound = has_tag && size <= file.size() - at && (type == mi_matrix || type == mi_compressed);
    if (sound && type == mi_matrix) image.bytes.append(file, at, size);
    if (sound && type == mi_compressed)
      sound = inflate_into(image.bytes, std::string_view(file).substr(at + tag_size, size - tag_size), path);
    if (!sound || !is_sound_element(std::string_view(image.bytes).substr(start), little_endian)) {
      throw FileError(path + ": is damaged or cut off in what begins at byte " + std::to_string(at) + " of " +
                      std::to_string(file.size()) + ". Save or copy it again.");
    }
    at += size;
    const std::size_t array = start + tag_size;
    if (auto object = object_in(std::string_view(image.bytes).substr(array), little_endian)) {
      image.objects.push_back(std::move(*object));
      image.bytes.resize(start);
      continue;
    }
    for (MatObject& object : hide_objects(image.bytes, array, little_endian))
      image.objects.push_back(std::move(object));
    ++image.variables;
  }
  return image;
}

}  // namespace ehm::tuner_design
