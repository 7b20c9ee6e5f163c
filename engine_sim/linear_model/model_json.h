// SPDX-License-Identifier: Apache-2.0
#pragma once
// LinearModel as JSON: the content of a model file, and a part of a design file.

#include <string>

#include "deploy/runtime/files/json_object.h"
#include "engine_sim/linear_model/capacity.h"
#include "engine_sim/linear_model/linear_model.h"

namespace ehm::linear_model {

/// @throws FileError for every defect of the content; the result has passed check_model.
LinearModel model_from_json(const files::Json& json, const std::string& file, const std::string& path,
                            int sensor_capacity = max_sensors);

/// @throws FileError if the model has a defect.
files::Json model_to_json(const LinearModel& model, const std::string& file);

}  // namespace ehm::linear_model
