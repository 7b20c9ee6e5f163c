// SPDX-License-Identifier: Apache-2.0
#pragma once
// Does an engine run? Its file has been read, so that each value by itself can be; here the engine flies:
//   design point   steady at the stated flight condition, off-take and fuel flow: speeds and unknowns within 2 % of
//                  what the file states
//   envelope       flight conditions from the ground to the ceiling, powers from idle to maximum (ratings.h): each has
//                  a steady point, with every stall margin above zero
// Errors: none; what fails is in the result.

#include <string>
#include <vector>

#include "engine_sim/model/engine_data.h"

namespace ehm::engine_sim {

inline constexpr double design_tolerance = 0.02;  ///< relative

/// A number of the design point, as stated and as it comes out.
struct StatedNumber {
  std::string name;
  double stated = 0.0, solved = 0.0;
  double deviation() const { return solved / stated - 1.0; }
  bool holds() const;
};

struct EngineCheck {
  std::vector<StatedNumber> design;  ///< empty where the design point has no solution
  std::string design_defect;         ///< why not
  std::size_t points = 0;            ///< of the envelope
  std::vector<std::string> failed;   ///< where, at which power, and why
  std::vector<std::string> surging;  ///< where, at which power, which component

  bool passed() const;
};

EngineCheck check_engine(const EngineData& data);

}  // namespace ehm::engine_sim
