#pragma once
// How a design was made, as the object "made_by" of a design file.

#include <string>

#include "monitor/design/design.h"
#include "monitor/design/json_object.h"

namespace ehm::design {

/// "closed-form", "kalman" or "map": as in files and on the command line.
const char* name_of(Tuning tuning);

Json options_to_json(const DesignOptions& options);
/// @throws FileError (file, key, value, allowed) for every defect.
DesignOptions options_from_json(const Json& json, const estimation::LinearModel& model, const std::string& file);

}  // namespace ehm::design
