// SPDX-License-Identifier: Apache-2.0
#pragma once
// The schedule of a design file, key "schedule": axes, the powers of each channel's similarity, and the nodes.
// @throws FileError (file, key, value, allowed) from reading what is incomplete, of a wrong shape or no grid, and from
// writing a number that is not finite.

#include <string>

#include "deploy/runtime/files/json_object.h"
#include "engine_sim/linear_model/linear_model.h"
#include "monitor/schedule/schedule.h"

namespace ehm::design {

files::Json schedule_to_json(const schedule::Schedule& schedule, const std::string& file);
/// `model`: whose channels the nodes have.
schedule::Schedule schedule_from_json(const files::Json& value, const linear_model::LinearModel& model,
                                      const std::string& file);

}  // namespace ehm::design
