// SPDX-License-Identifier: Apache-2.0
#pragma once
// The control of the JT9D-class engine: limits, gains, schedules. Sources: jt9d_control.cpp, number by number.

#include "engine_sim/engines/control_data.h"

namespace ehm::engine_sim {

ControlData jt9d_control();

}  // namespace ehm::engine_sim
