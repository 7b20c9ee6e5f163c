#pragma once
// The control of the JT9D-class engine: limits, gains, schedules. Sources: jt9d_control.cpp, number by number.

#include "engine_sim/control/control_data.h"

namespace ehm::engine {

ControlData jt9d_control();

}  // namespace ehm::engine
