#include "tuner_design/import/mat_container.h"

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>

#include "deploy/files/file_error.h"

namespace ehm::bench {
namespace {

using files::FileError;

constexpr std::size_t header_size = 128, tag_size = 8;
constexpr std::uint32_t mi_matrix = 14, mi_compressed = 15;

std::uint32_t unsigned_at(const char* bytes, std::size_t size, bool little_endian) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const auto byte = static_cast<unsigned char>(bytes[little_endian ? size - 1 - i : i]);
    value = value << 8U | byte;
  }
  return value;
}

/// @returns true if little endian.
bool read_header(std::ifstream& in, const std::string& path) {
  std::array<char, header_size> header{};
  in.read(header.data(), header.size());
  const bool complete = in.gcount() == static_cast<std::streamsize>(header_size);
  const bool little = header[126] == 'I' && header[127] == 'M', big = header[126] == 'M' && header[127] == 'I';
  const std::uint32_t version = unsigned_at(&header[124], 2, little);
  if (complete && (little || big) && version == 0x0100) return little;
  const bool hdf5 = std::memcmp(header.data(), "\x89HDF", 4) == 0 || (complete && version == 0x0200);
  throw FileError(path + ": is " + (hdf5 ? "a MATLAB v7.3 (HDF5) file" : "no MATLAB v5 file") +
                  "; allowed: what save writes with -v6 or -v7. Save it again: save('-v7', 'model.mat', ...).");
}

}  // namespace

std::size_t count_mat_elements(const std::string& path) {
  errno = 0;
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in)
    throw FileError(path + ": cannot be read: " + std::strerror(errno) + ". Check the path and the permissions.");
  const auto size = static_cast<std::uint64_t>(in.tellg());
  in.seekg(0);
  const bool little_endian = read_header(in, path);
  std::size_t count = 0;
  for (std::uint64_t at = header_size; at < size; ++count) {
    std::array<char, tag_size> tag{};
    in.seekg(static_cast<std::streamoff>(at));
    in.read(tag.data(), tag.size());
    const std::uint32_t type = unsigned_at(tag.data(), 4, little_endian);
    const std::uint64_t end = at + tag_size + unsigned_at(&tag[4], 4, little_endian);
    if (!in || end > size || (type != mi_matrix && type != mi_compressed)) {
      throw FileError(path + ": is damaged or cut off at byte " + std::to_string(at) + " of " + std::to_string(size) +
                      ". Save or copy it again.");
    }
    at = end;
  }
  return count;
}

}  // namespace ehm::bench
