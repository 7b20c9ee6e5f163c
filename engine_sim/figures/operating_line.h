// SPDX-License-Identifier: Apache-2.0
#pragma once
// The operating line: steady points of the new engine from maximum power down to idle (ratings.h), on standard
// geometry, in even steps of fan speed.

#include <string>
#include <vector>

#include "engine_sim/model/solve/steady.h"

namespace ehm::engine_sim {

struct OperatingLine {
  std::string label;
  std::vector<SteadyPoint> points;  ///< from maximum to idle
};

/// Sea level static (the design point's day) and cruise.
/// @throws SolveError if a point of the line is not found
std::vector<OperatingLine> operating_lines(const Turbofan& engine);

}  // namespace ehm::engine_sim
