#pragma once
// The operating line: steady points of the new engine from maximum power down to idle, on standard geometry.
//   maximum: at sea level the design point's fuel flow, at cruise a T40;  idle: 7 % of the thrust at maximum
// Sources: the design point from the engine's file, T40 at cruise from power code 100 at 35 000 ft, Mach 0.8 (2355.4
// degR, reference/jt9d_npss_cases.csv); idle as in the ICAO landing and take-off cycle (Annex 16, volume II: 7 % of
// rated).

#include <string>
#include <vector>

#include "engine_sim/model/steady.h"

namespace ehm::engine {

struct OperatingLine {
  std::string label;
  std::vector<SteadyPoint> points;  ///< from maximum to idle
};

/// Sea level static (the design point's day) and cruise.
/// @throws SolveError if a point of the line is not found
std::vector<OperatingLine> operating_lines(const Turbofan& engine);

}  // namespace ehm::engine
