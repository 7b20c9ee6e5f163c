// SPDX-License-Identifier: Apache-2.0
#pragma once
// Writes one recording file so that it is readable at any moment: while it grows, and after kill -9. One exception
// remains: a kill within the microsecond in which the kernel copies a piece of HDF5's metadata from one memory page to
// the next leaves half of it, and the reader refuses the file.
//
// HDF5's single-writer mode (SWMR) orders its own metadata; the order of ours is: all tables of doubles and the design
// hashes first, flushed, then A, flushed. A row of A therefore never comes without its values. Rows wait in memory for
// commit(): whole chunks are written as they fill; a part of a chunk only on demand, since the single-writer mode
// cannot reuse the space of a chunk that is written twice.
//
// @throws files::FileError naming the file and HDF5's reason; the writer is not usable afterwards.

#include <cstdint>
#include <string>
#include <vector>

#include "deploy/runtime/recording/hdf5_object.h"
#include "deploy/runtime/recording/layout.h"

namespace ehm::recording {

class Writer {
 public:
  static constexpr std::size_t chunk_rows = 64;  ///< about a second of one engine
  static constexpr unsigned compression = 1;     ///< of deflate; more costs time and gains little on noise

  /// Creates `path`, which must not exist.
  Writer(const std::string& path, const FileInfo& info);
  /// Commits what waits, as far as that succeeds.
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// Row of the design in `design_hash`; a new one is added.
  std::int64_t design_index(const std::string& hash);
  void append(const Row& row, std::int64_t design_index) {
    pending_.push_back(row);
    pending_.back().a.design = design_index;
  }
  /// Rows that wait for a commit.
  std::size_t pending() const { return pending_.size(); }
  /// Writes and flushes the waiting rows that fill a chunk, or all of them.
  void commit(bool all);
  /// Rows in the file.
  std::uint64_t rows() const { return rows_; }
  std::uint64_t bytes() const;
  const std::string& path() const { return path_; }
  const Channels& channels() const { return channels_; }

 private:
  struct Table {
    Hdf5Object dataset;
    std::size_t width = 0;
  };
  void create_tables();
  Table create_table(const char* name, std::size_t width, hid_t type, const void* fill);
  void write_names(const std::string& name, const std::vector<Channel>& channels);
  void write_attributes(const FileInfo& info);
  void write_doubles(std::size_t count);
  void write_identities(std::size_t count);
  void write_block(const Table& table, const char* name, hid_t type, std::size_t count, const void* values);
  void flush();

  std::string path_;
  Channels channels_;
  Hdf5Object file_;
  std::vector<Table> doubles_;  ///< as double_tables(); width 0: the recorded engines have no such channels
  Table identities_;
  Hdf5Object design_hashes_;
  std::vector<std::string> hashes_;
  std::vector<Row> pending_;
  std::vector<double> block_;
  std::uint64_t rows_ = 0;
};

}  // namespace ehm::recording
