// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/recording/part_files.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>

namespace ehm::recording {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t digits = 4;  // more where the number needs more

/// Number of the part that the file name `candidate` is; 0 if it is none of `file`.
std::int64_t number_of(const std::string& candidate, const fs::path& file) {
  if (candidate == file.filename()) return 1;
  const std::string head = file.stem().string() + ".", tail = file.extension().string();
  if (!candidate.starts_with(head) || !candidate.ends_with(tail)) return 0;
  if (candidate.size() < head.size() + digits + tail.size()) return 0;
  const char* begin = candidate.data() + head.size();
  const char* end = candidate.data() + candidate.size() - tail.size();
  std::int64_t number = 0;
  const auto [stop, error] = std::from_chars(begin, end, number);
  return error == std::errc() && stop == end && number > 1 ? number : 0;
}

}  // namespace

std::string part_name(const std::string& file, std::int64_t number) {
  if (number <= 1) return file;
  char text[24];
  std::snprintf(text, sizeof text, ".%04lld", static_cast<long long>(number));
  const fs::path path(file);
  return (path.parent_path() / (path.stem().string() + text + path.extension().string())).string();
}

std::string following_part(const std::string& path) {
  const fs::path part(path), stem(part.stem());
  const fs::path first = part.parent_path() / (stem.stem().string() + part.extension().string());
  const std::int64_t number = number_of(part.filename().string(), first);
  return number > 1 ? part_name(first.string(), number + 1) : part_name(path, 2);
}

std::vector<std::int64_t> existing_parts(const std::string& file) {
  const fs::path path(file);
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::vector<std::int64_t> numbers;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (const auto number = number_of(entry.path().filename().string(), path); number != 0) numbers.push_back(number);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

std::int64_t next_part(const std::string& file) {
  const auto numbers = existing_parts(file);
  return numbers.empty() ? 1 : numbers.back() + 1;
}

}  // namespace ehm::recording
