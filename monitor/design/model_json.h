#pragma once
// LinearModel as JSON: the content of a model file, and a part of a design file.

#include <string>

#include "monitor/design/json_object.h"
#include "monitor/estimation/capacity.h"
#include "monitor/estimation/linear_model.h"

namespace ehm::design {

/// @throws FileError for every defect of the content; the result has passed check_model.
estimation::LinearModel model_from_json(const Json& json, const std::string& file, const std::string& path,
                                        int sensor_capacity = estimation::max_sensors);

/// @throws FileError if the model has a defect.
Json model_to_json(const estimation::LinearModel& model, const std::string& file);

}  // namespace ehm::design
