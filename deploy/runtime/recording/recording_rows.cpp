// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/recording/recording_rows.h"

#include <filesystem>

#include "deploy/runtime/recording/csv_rows.h"
#include "deploy/runtime/recording/part_files.h"

namespace ehm::recording {

bool RecordingRows::next(Row& row) {
  while (!reader_->next(row))
    if (!open_following_part()) return false;
  return true;
}

bool RecordingRows::open_following_part() {
  const std::string path = following_part(path_);
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return false;
  FileReader following(path);
  const FileInfo &now = reader_->info(), &then = following.info();
  // Another recording may have gone on with the numbers.
  if (then.recording_id != now.recording_id || then.part != now.part + 1 || then.channels != now.channels) return false;
  path_ = path;
  reader_.emplace(std::move(following));
  return true;
}

std::string RecordingRows::design_hash(const Row& row) const {
  const auto& hashes = reader_->design_hashes();
  const auto index = static_cast<std::size_t>(row.a.design);
  return row.a.estimates != 0 && index < hashes.size() ? hashes[index] : std::string();
}

std::unique_ptr<RowSource> open_rows(const std::string& file, const std::string& column_map) {
  if (column_map.empty()) return std::make_unique<RecordingRows>(file);
  return std::make_unique<CsvRows>(file, read_column_map(column_map));
}

}  // namespace ehm::recording
