// SPDX-License-Identifier: Apache-2.0
#pragma once
// SubsetDesign as JSON, a part of the design file; shapes are in monitor/design/design.h.

#include <string>

#include "deploy/runtime/files/json_object.h"
#include "monitor/design/design.h"

namespace ehm::design {

/// @throws FileError if a key is missing or unknown, a matrix has the wrong shape for `model`, a sensor index is out of
///         range, a variance is negative, the closed loop A - K C A over the used sensors is unstable, or no noise
///         reaches some tuner. Without health_readout and auxiliary_readout they are W and N W.
SubsetDesign subset_from_json(const files::Json& json, const linear_model::LinearModel& model,
                              const linear_model::Scaling& scaling, const std::string& file, const std::string& path);

/// `own_readout`: Rh and Rz are not W and N W, and written. @throws FileError if a number is not finite.
files::Json subset_to_json(const SubsetDesign& design, bool own_readout, const std::string& file,
                           const std::string& path);

}  // namespace ehm::design
