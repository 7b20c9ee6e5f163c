// SPDX-License-Identifier: Apache-2.0
#pragma once
// Reads one recording file from its first row to the last that was committed: also while it is being written, and after
// its writer was killed.
//
// @throws files::FileError if the file is no recording, is of another format version, or is damaged.

#include <cstdint>
#include <string>
#include <vector>

#include "deploy/runtime/recording/hdf5_object.h"
#include "deploy/runtime/recording/layout.h"

namespace ehm::recording {

class FileReader {
 public:
  explicit FileReader(const std::string& path);

  bool next(Row& row);
  const FileInfo& info() const { return info_; }
  const std::vector<std::string>& design_hashes() const { return design_hashes_; }
  /// Its writer did not close it: it is being written, or was cut off.
  bool unfinished() const { return unfinished_; }

 private:
  static constexpr std::size_t block_rows = 1024;
  void open();
  void read_info();
  std::vector<Channel> read_channels(const std::string& name) const;
  std::vector<std::string> read_texts(const std::string& name) const;
  void open_tables();
  void read_block();
  void read_table(hid_t dataset, const char* name, hid_t type, std::size_t count, std::size_t width,
                  void* values) const;

  std::string path_;
  bool unfinished_ = false;
  Hdf5Object file_, identities_;
  std::vector<Hdf5Object> doubles_;
  std::vector<std::size_t> widths_;
  FileInfo info_;
  std::vector<std::string> design_hashes_;
  std::uint64_t total_rows_ = 0, read_rows_ = 0;
  std::vector<Row> block_;
  std::size_t position_ = 0;
};

}  // namespace ehm::recording
