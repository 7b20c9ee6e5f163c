// SPDX-License-Identifier: Apache-2.0
#pragma once
// The cases of the fault study, in one table: what breaks, how much, and how often it comes in a round.
//
// A round holds every row of the table for every channel that it concerns, in the table's order; case c of a study is
// entry c modulo the length of a round, on engine c of the fleet. Sizes of sensor faults are in noise sigmas of the
// sensor. Errors: none.

#include <cstddef>
#include <string>
#include <vector>

namespace ehm::tuner_design {

enum class Broken { nothing, bias, stuck, drift, noise, dropout, component };

/// One row of the table.
struct FaultRow {
  const char* name;
  Broken broken;
  double size;           ///< sigmas; drift: sigmas in a minute; noise: factor; component: fraction of nominal
  bool abrupt;           ///< counts for the figures of abrupt faults
  double watched_s;      ///< after the onset
  std::size_t repeated;  ///< in a round, for each channel
  /// How often it breaks in the field, each channel: assumed (orders of magnitude; the papers state none). Both signs
  /// and sizes of a bias share one rate.
  double per_million_hours;
};

/// For seven sensors and ten health parameters a round has 80 cases.
const std::vector<FaultRow>& fault_table();

struct FaultCase {
  const FaultRow* row;
  std::size_t channel = 0;  ///< sensor or health parameter
};

std::vector<FaultCase> round_of_cases(std::size_t sensors, std::size_t health);

}  // namespace ehm::tuner_design
