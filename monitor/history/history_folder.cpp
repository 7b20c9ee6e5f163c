// SPDX-License-Identifier: Apache-2.0
#include "monitor/history/history_folder.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <set>

#include "deploy/runtime/files/atomic_file.h"
#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/files/input_file.h"

namespace ehm::monitor {

namespace {

constexpr std::string_view prefix = "engine_", baseline_suffix = "_baseline.json", flights_suffix = "_flights.jsonl";
constexpr std::uintmax_t largest_baseline = 1 << 20;   // of full capacity it is below 100 kB
constexpr std::uintmax_t largest_history = 256 << 20;  // a flight is some 2 kB

std::string path(const std::string& folder, std::uint32_t engine_id, std::string_view suffix) {
  return (std::filesystem::path(folder) / (std::string(prefix) + std::to_string(engine_id) + std::string(suffix)))
      .string();
}

/// The engine of a file with that suffix; 0 if it is none.
std::uint32_t engine_of(const std::string& name, std::string_view suffix) {
  if (!name.starts_with(prefix) || !name.ends_with(suffix) || name.size() < prefix.size() + suffix.size()) return 0;
  const char* begin = name.data() + prefix.size();
  const char* end = name.data() + name.size() - suffix.size();
  std::uint32_t id = 0;
  const auto [stop, error] = std::from_chars(begin, end, id);
  return error == std::errc() && stop == end ? id : 0;
}

bool missing(const std::string& file) {
  std::error_code unknown;
  return !std::filesystem::exists(file, unknown) && !unknown;
}

[[noreturn]] void fail(const std::string& file) {
  throw files::FileError(file + ": cannot be written: " + std::strerror(errno));
}

/// Closes itself.
struct Descriptor {
  explicit Descriptor(int d) : descriptor(d) {}
  ~Descriptor() {
    if (descriptor >= 0) close(descriptor);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int descriptor;
};

}  // namespace

std::string baseline_path(const std::string& folder, std::uint32_t engine_id) {
  return path(folder, engine_id, baseline_suffix);
}

std::string flights_path(const std::string& folder, std::uint32_t engine_id) {
  return path(folder, engine_id, flights_suffix);
}

std::vector<std::uint32_t> engines_in(const std::string& folder) {
  std::error_code unreadable;
  std::set<std::uint32_t> ids;
  for (const auto& entry : std::filesystem::directory_iterator(folder, unreadable))
    for (const std::string_view suffix : {baseline_suffix, flights_suffix})
      if (const std::uint32_t id = engine_of(entry.path().filename().string(), suffix); id != 0) ids.insert(id);
  if (unreadable) throw files::FileError(folder + ": cannot be read: " + unreadable.message());
  return {ids.begin(), ids.end()};
}

std::optional<Baseline> read_baseline(const std::string& folder, std::uint32_t engine_id) {
  const std::string file = baseline_path(folder, engine_id);
  if (missing(file)) return std::nullopt;
  Baseline baseline = parse_baseline(files::read_input_file(file, {"a baseline", largest_baseline}), file);
  if (baseline.engine_id != engine_id)
    throw files::FileError(file + ": holds engine " + std::to_string(baseline.engine_id) + ", its name says " +
                           std::to_string(engine_id));
  return baseline;
}

void write_baseline(const std::string& folder, const Baseline& baseline) {
  files::write_file_atomically(baseline_path(folder, baseline.engine_id), to_text(baseline));
}

FlightHistory read_history(const std::string& folder, std::uint32_t engine_id) {
  FlightHistory history = read_what_can_be(folder, engine_id);
  if (!history.damaged.empty()) throw files::FileError(history.damaged.front());
  return history;
}

FlightHistory read_what_can_be(const std::string& folder, std::uint32_t engine_id) {
  FlightHistory history;
  const std::string file = flights_path(folder, engine_id);
  if (missing(file)) return history;
  const std::string text = files::read_input_file(file, {"a flight history", largest_history});
  std::size_t number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = std::string_view(text).substr(begin, end - begin);
    const std::string where = file + ":" + std::to_string(++number);
    begin = end + 1;
    if (line.empty()) continue;
    if (end < text.size()) {
      try {
        history.entries.push_back(parse_line(line, where));
        if (history.entries.back().flight) history.damaged_since_flight = false;
      } catch (const files::FileError& error) {
        history.damaged.emplace_back(error.what());
        history.damaged_since_flight = true;
      }
      continue;
    }
    try {
      history.entries.push_back(parse_line(line, where));
    } catch (const files::FileError& error) {
      history.torn = error.what();
    }
  }
  return history;
}

void add_to_history(const std::string& folder, std::uint32_t engine_id, const std::string& line) {
  const std::string file = flights_path(folder, engine_id);
  const Descriptor out(open(file.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC, 0644));
  if (out.descriptor < 0) fail(file);
  char last = '\n';
  const off_t size = lseek(out.descriptor, 0, SEEK_END);
  if (size > 0 && pread(out.descriptor, &last, 1, size - 1) != 1) fail(file);
  const std::string text = (last == '\n' ? "" : "\n") + line;
  // One write, so that what another process adds comes before or behind.
  const ssize_t written = write(out.descriptor, text.data(), text.size());
  if (written != static_cast<ssize_t>(text.size()) || fsync(out.descriptor) != 0) fail(file);
}

}  // namespace ehm::monitor
