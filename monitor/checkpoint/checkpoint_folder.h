// SPDX-License-Identifier: Apache-2.0
#pragma once
// The folder with one checkpoint file per engine, and what of it may be resumed at start.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "monitor/checkpoint/checkpoint.h"

namespace ehm::monitor {

/// FOLDER/engine_ID.json
std::string checkpoint_path(const std::string& folder, std::uint32_t engine_id);

/// Tried at start, so that a wrong folder is found by the operator and not by the first kill.
/// `key`: that names it, for the message.
/// @throws files::FileError with the folder and the system's reason if it does not exist or cannot be written.
void require_writable_folder(const std::string& folder, const char* key);

/// A file that was not taken: which, and one sentence why.
struct RefusedCheckpoint {
  std::uint32_t engine_id = 0;  ///< 0: the file's name tells none
  std::string why;              ///< names the file
};

/// Checkpoints by engine, made at start and only read afterwards.
class ResumeTable {
 public:
  ResumeTable() = default;
  /// Reads every engine_*.json of `folder`; each is in the table or in `refused`. `design_hash_of` tells the design
  /// that will fly for an engine, empty for one that nobody serves. Older than `max_age_s` by the wall clock, or from
  /// the future by more than that, is refused.
  ResumeTable(const std::string& folder, double max_age_s, std::int64_t wall_time_ns,
              const std::function<std::string(std::uint32_t)>& design_hash_of, std::vector<RefusedCheckpoint>& refused);

  /// nullptr if there is none. Real-time safe: yes.
  const Checkpoint* find(std::uint32_t engine_id) const noexcept;
  std::size_t size() const noexcept { return checkpoints_.size(); }

 private:
  std::vector<Checkpoint> checkpoints_;  ///< sorted by engine_id
};

}  // namespace ehm::monitor
