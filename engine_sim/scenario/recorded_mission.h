// SPDX-License-Identifier: Apache-2.0
#pragma once
// A flight that an aircraft has flown, from a table (CSV with a header), as a profile of this engine. Columns, in any
// order, others are left alone:
//   time_s                                                 ascending
//   altitude_m | altitude_ft | pressure_altitude_ft
//   mach | true_airspeed_m_s | true_airspeed_kt            by the speed of sound of the day
//   n1_rpm | fuel_flow_kg_s | fuel_flow_kg_h
//   delta_isa_k                                            0 where there is none
//
// A fuel flow may be of any engine, or of several: what counts is its share. Reduced by delta sqrt(theta), its greatest
// is this engine's take-off, and each other share is flown at the fan speed at which this engine burns it; nothing
// burnt is taxi. Points five seconds apart, means of what lies between. Of the options power multiplies all fan speeds,
// and offtake 1 kg/s of bleed (less below Mach 0.5) and 80 kW.
// Errors: @throws files::FileError (file, line, column, allowed) for a table that is none, lacks a column, or leaves
// the atmosphere; SolveError if the engine does not run on the ground.

#include <string>
#include <vector>

#include "engine_sim/engines/engine_definition.h"
#include "engine_sim/scenario/mission.h"

namespace ehm::engine_sim {

std::vector<ProfilePoint> recorded_mission(const std::string& file, const EngineDefinition& engine,
                                           const MissionOptions& options);

}  // namespace ehm::engine_sim
