// SPDX-License-Identifier: Apache-2.0
#pragma once
// SubsetDesign as JSON, a part of the design file; shapes are in monitor/design/design.h.

#include <string>

#include "deploy/runtime/files/json_object.h"
#include "monitor/design/design.h"

namespace ehm::design {

/// @throws FileError if a key is missing or unknown, a matrix has the wrong shape for `model`, a sensor index is out of
///         range, a variance is negative, or the closed loop A - K C A over the used sensors is unstable.
SubsetDesign subset_from_json(const files::Json& json, const linear_model::LinearModel& model, const std::string& file,
                              const std::string& path);

/// @throws FileError if a number is not finite.
files::Json subset_to_json(const SubsetDesign& design, const std::string& file, const std::string& path);

}  // namespace ehm::design
