// SPDX-License-Identifier: Apache-2.0
#pragma once
// A flight of two hours from taxi to taxi, as a profile: taxi, take-off, climb, two cruise levels, idle descent,
// approach, landing, taxi; with customer bleed and shaft power as an airliner takes them.
//
//   0 - 420 s      taxi out                         5400 - 6600   idle descent from 10 668 to 3000 m
//   420 - 560      take-off and first climb         6600 - 6900   approach
//   560 - 1560     climb to 9449 m                  6900 - 6930   landing
//   1560 - 3600    cruise at 9449 m, Mach 0.80      6930 - 7200   taxi in
//   3600 - 5400    climb to and cruise at 10 668 m
//
// Power is a share of the design point's corrected fan speed:  n1_rpm = share N1cd sqrt(theta2); idle is a demand that
// lies below every idle, so that the control's idle loop decides. A compressed mission has all times multiplied.
// Errors: none. Units: SI.

#include <vector>

#include "engine_sim/model/engine_data.h"
#include "engine_sim/scenario/scenario.h"

namespace ehm::engine_sim {

struct MissionOptions {
  double delta_isa_k = 0.0;
  double offtake = 1.0;     ///< times what is listed, bleed and power
  double power = 1.0;       ///< times the shares above idle
  double time_scale = 1.0;  ///< below 1: compressed
};

inline constexpr double mission_seconds = 7200.0;

std::vector<ProfilePoint> two_hour_mission(const EngineData& engine, const MissionOptions& options);

}  // namespace ehm::engine_sim
