// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tables 4 to 7 of Simon & Garg, NASA/TM-2010-216077, as published: mean squared errors, health in percent^2, T40 and
// T50 in degR^2, Fn and SmLPC in percent^2. Their engine is C-MAPSS, ours is not: the numbers are context, no target.
// Channels in the order of the paper's table 1 (fan, LPC, HPC, HPT, LPT; efficiency before flow) and table 3.

#include <array>
#include <span>

namespace ehm::tuner_design {

struct PublishedRow {
  const char* tuners;             ///< "10 health parameters", "a" to "h", "subset of 7"
  bool experiment;                ///< else theory
  std::array<double, 11> values;  ///< channels, then SSEE; what follows the SSEE of a shorter row is 0
};

/// Number of channels of a table: 10 (health) or 4 (auxiliary).
constexpr std::size_t published_channels(int table) {
  return table == 4 || table == 6 ? 10 : 4;
}

/// Rows of table 4, 5, 6 or 7; empty for any other number.
std::span<const PublishedRow> published_table(int table);

}  // namespace ehm::tuner_design
