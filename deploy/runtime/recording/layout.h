// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a recording holds: which tables, with which columns. Writer and reader both go by this, so that they agree.
//
//   dataset            type     columns
//   A                  int64    identity and decisions of each row (row.h, Identity)
//   W                  double   flight condition, actuators
//   X_s                double   sensors                 R                           innovation, sensor unit
//   X_v                double   auxiliary estimates     X_v_sigma, X_v_sigma_filter standard deviations
//   T                  double   health estimates        T_sigma, T_sigma_filter     standard deviations
//
// Beside W, X_s, X_v, T and A stand NAME_var and NAME_unit: names and units of the columns, texts of 64 bytes.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "deploy/runtime/recording/row.h"

namespace ehm::recording {

inline constexpr const char* format_name = "ehm-recording";
inline constexpr std::int64_t format_version = 1;
inline constexpr std::size_t text_size = 64;  ///< bytes of a name, a unit or a design hash in the file

struct Channel {
  std::string name, unit;
  bool operator==(const Channel&) const = default;
};

/// The channels of the recorded engines, in the order of the wire; one file has one set of them.
struct Channels {
  std::vector<Channel> actuators, sensors, auxiliary, health;
  bool operator==(const Channels&) const = default;
};

/// What describes a whole file, as its attributes.
struct FileInfo {
  std::int64_t recording_id = 0;  ///< wall clock of the start, ns since 1970: the same in all parts of one recording
  std::int64_t part = 1;          ///< counts the files of one recording from 1
  std::int64_t monitor_source_id = 0;
  double sample_time_s = 0.0;  ///< of the design
  std::string created_by;
  std::string published;  ///< name of the estimator whose estimates stand in the samples' rows; empty: not stated
  std::string shadows;    ///< names of the estimators whose rows stand behind each sample's, with commas between
  Channels channels;
};

/// Whose channels a table of doubles has.
enum class ChannelGroup { flight_and_actuators, sensors, auxiliary, health };

struct DoubleTable {
  const char* name;
  ChannelGroup group;
  double* (*values)(Row&);  ///< the first of them in a row
};

/// Every table of doubles, in the order in which they are written.
const std::array<DoubleTable, 9>& double_tables();
/// Names and units of the columns of A.
const std::array<Channel, identity_columns>& identity_channels();
/// Columns of a group in a file with these channels.
std::vector<Channel> columns(const Channels& channels, ChannelGroup group);

}  // namespace ehm::recording
