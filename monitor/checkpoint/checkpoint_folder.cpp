// SPDX-License-Identifier: Apache-2.0
#include "monitor/checkpoint/checkpoint_folder.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "deploy/runtime/files/atomic_file.h"
#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/files/input_file.h"
#include "deploy/runtime/files/json_object.h"

namespace ehm::monitor {

namespace {

constexpr std::string_view prefix = "engine_", suffix = ".json";
constexpr std::uintmax_t largest_file = 1 << 20;  // a checkpoint of full capacity is below 100 kB

/// The engine that a file name stands for; 0 if it is no checkpoint's name.
std::uint32_t engine_of(const std::string& name) {
  if (name.size() <= prefix.size() + suffix.size() || !name.starts_with(prefix) || !name.ends_with(suffix)) return 0;
  const char* begin = name.data() + prefix.size();
  const char* end = name.data() + name.size() - suffix.size();
  std::uint32_t id = 0;
  const auto [stop, error] = std::from_chars(begin, end, id);
  return error == std::errc() && stop == end ? id : 0;
}

std::string read_text(const std::filesystem::path& path) {
  return files::read_input_file(path.string(), {"a checkpoint", largest_file});
}

/// Why a readable checkpoint does not belong here and now; empty if it does.
std::string misfit(const Checkpoint& c, std::uint32_t named, const std::string& design_hash, double max_age_s,
                   std::int64_t wall_time_ns) {
  if (c.engine_id != named)
    return "holds engine " + std::to_string(c.engine_id) + ", its name says " + std::to_string(named);
  if (design_hash.empty()) return "no design serves this engine";
  if (c.design_hash != design_hash)
    return "was made with design " + c.design_hash.substr(0, 12) + ", now flies " + design_hash.substr(0, 12);
  const double age_s = 1e-9 * (static_cast<double>(wall_time_ns) - static_cast<double>(c.wall_time_ns));
  if (std::abs(age_s) > max_age_s)
    return "is " + files::shown(std::round(age_s)) + " s old, checkpoint.max_age_s allows " + files::shown(max_age_s);
  return {};
}

}  // namespace

std::string checkpoint_path(const std::string& folder, std::uint32_t engine_id) {
  return (std::filesystem::path(folder) / (std::string(prefix) + std::to_string(engine_id) + std::string(suffix)))
      .string();
}

void require_writable_folder(const std::string& folder, const char* key) {
  try {
    const std::string probe = (std::filesystem::path(folder) / "writable").string();
    files::AtomicFile file(probe);  // its temporary file is gone without commit()
  } catch (const files::FileError& e) {
    throw files::FileError(
        "'" + std::string(key) + "' is '" + folder + "', which cannot be written: " + e.what() +
        " The unit ehm-monitor@NAME makes /var/lib/ehm/NAME at its start, and may write nowhere else.");
  }
}

ResumeTable::ResumeTable(const std::string& folder, double max_age_s, std::int64_t wall_time_ns,
                         const std::function<std::string(std::uint32_t)>& design_hash_of,
                         std::vector<RefusedCheckpoint>& refused) {
  std::error_code unreadable;
  for (const auto& entry : std::filesystem::directory_iterator(folder, unreadable)) {
    const std::uint32_t id = engine_of(entry.path().filename().string());
    if (id == 0) continue;
    const std::string file = entry.path().string();
    try {
      Checkpoint checkpoint = parse_checkpoint(read_text(entry.path()), file);
      const std::string why = misfit(checkpoint, id, design_hash_of(id), max_age_s, wall_time_ns);
      if (why.empty())
        checkpoints_.push_back(std::move(checkpoint));
      else
        refused.push_back({id, file + ": " + why});
    } catch (const std::exception& e) {
      refused.push_back({id, e.what()});
    }
  }
  if (unreadable) refused.push_back({0, folder + ": cannot be read: " + unreadable.message()});
  std::sort(checkpoints_.begin(), checkpoints_.end(),
            [](const Checkpoint& a, const Checkpoint& b) { return a.engine_id < b.engine_id; });
}

const Checkpoint* ResumeTable::find(std::uint32_t engine_id) const noexcept {
  const auto it = std::lower_bound(checkpoints_.begin(), checkpoints_.end(), engine_id,
                                   [](const Checkpoint& c, std::uint32_t id) { return c.engine_id < id; });
  return it != checkpoints_.end() && it->engine_id == engine_id ? &*it : nullptr;
}

}  // namespace ehm::monitor
