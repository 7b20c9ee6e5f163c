// SPDX-License-Identifier: Apache-2.0
#pragma once
// Where an on-board engine begins: the spools turn as measured; one that no sensor measures is let run until the others
// hold it, and the metal is in balance with the gas. A guess by the design point is its start:
//   N2/sqrt(theta) = N2d (0.6 + 0.4 N1c/N1cd), and back;  N1c/N1cd = (Wfc/Wfcd)^0.4 where neither is measured
// Speeds in rpm, NaN: not measured. Errors: none as a value where the engine has no answer on the way.
// Real-time safe: yes (400 answers of the engine at most, where a speed is missing).

#include <array>
#include <optional>

#include "engine_sim/model/onboard/on_board_engine.h"
#include "monitor/onboard/engine_motion.h"
#include "monitor/onboard/unknowns.h"

namespace ehm::onboard {

std::optional<EngineMotion> start_motion(const OnBoardModel& model, const engine_sim::Operation& operation,
                                         const std::array<double, speed_count>& measured_rpm,
                                         engine_sim::OnBoardEngine& engine) noexcept;

}  // namespace ehm::onboard
