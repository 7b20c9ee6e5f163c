// SPDX-License-Identifier: Apache-2.0
#pragma once
// The control's part of an engine file (control_data.h), the object `control`: limits, fuel, vanes, bleed_valves,
// middle_n1_corrected_rpm. A schedule is [[at, value], ...] with ascending `at`.
// @throws files::FileError (file, key, value, allowed); also where deceleration is not below acceleration everywhere,
//         or an idle not below its limit.

#include "deploy/runtime/files/json_object.h"
#include "engine_sim/engines/control_data.h"

namespace ehm::engine_sim {

ControlData control_from(files::JsonObject& root);
files::Json to_json(const ControlData& control);

}  // namespace ehm::engine_sim
