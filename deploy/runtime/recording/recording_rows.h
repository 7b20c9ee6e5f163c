// SPDX-License-Identifier: Apache-2.0
#pragma once
// The rows of a recording: of the file that is named, and of the parts that follow it in its folder.

#include <optional>

#include "deploy/runtime/recording/file_reader.h"
#include "deploy/runtime/recording/row_source.h"

namespace ehm::recording {

class RecordingRows : public RowSource {
 public:
  /// @throws files::FileError as FileReader does
  explicit RecordingRows(const std::string& file) : path_(file), info_(reader_.emplace(file).info()) {}

  bool next(Row& row) override;
  const FileInfo& info() const override { return info_; }
  std::string design_hash(const Row& row) const override;

 private:
  bool open_following_part();

  std::string path_;
  std::optional<FileReader> reader_;
  FileInfo info_;  ///< of the first file
};

}  // namespace ehm::recording
