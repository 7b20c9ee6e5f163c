// SPDX-License-Identifier: Apache-2.0
#pragma once
// Where rows come from, one after another: a recording, or a CSV file by a column map (csv_rows.h).

#include <cstdint>
#include <memory>
#include <string>

#include "deploy/runtime/recording/layout.h"

namespace ehm::recording {

class RowSource {
 public:
  virtual ~RowSource() = default;
  /// The next row in the order in which the monitor saw them. False at the end.
  /// @throws files::FileError if the file is damaged there.
  virtual bool next(Row& row) = 0;
  virtual const FileInfo& info() const = 0;
  /// Hash of the design that the row's estimates are of; empty without estimates.
  virtual std::string design_hash(const Row& row) const = 0;
};

/// Opens a recording and its later parts, or, with a column map, a CSV file.
/// @throws files::FileError or config::ConfigError naming file, line, column, value and what is allowed.
std::unique_ptr<RowSource> open_rows(const std::string& file, const std::string& column_map);

}  // namespace ehm::recording
