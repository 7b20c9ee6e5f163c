// SPDX-License-Identifier: Apache-2.0
#pragma once
// What of the on-board engine moves. Units: rpm, K. Errors: none.

#include "engine_sim/model/turbofan.h"

namespace ehm::onboard {

/// What moves on board, and of what the metal is made: all else is held or estimated as constant.
struct EngineMotion {
  engine_sim::SpoolSpeeds speeds;
  engine_sim::MetalTemperatures metal_k{};
  double conductance = 1.0, capacity = 1.0;  ///< 1 + a, 1 + b: over the engine file's
};

}  // namespace ehm::onboard
