// SPDX-License-Identifier: Apache-2.0
#pragma once
// How a design was made, as the object "made_by" of a design file.

#include <string>

#include "deploy/runtime/files/json_object.h"
#include "monitor/design/design.h"

namespace ehm::design {

/// "closed-form", "kalman" or "map": as in files and on the command line.
const char* name_of(Tuning tuning);

files::Json options_to_json(const DesignOptions& options);
/// @throws FileError (file, key, value, allowed) for every defect.
DesignOptions options_from_json(const files::Json& json, const linear_model::LinearModel& model,
                                const std::string& file);

}  // namespace ehm::design
