// SPDX-License-Identifier: Apache-2.0
#pragma once
// In words what the studies after Kosanam's thesis fly. Errors: none.

#include <string>
#include <vector>

#include "tuner_design/kosanam/flight_batches.h"

namespace ehm::tuner_design::report {

/// `health_variance`: qh, percent squared a sample; `not_known`: parameters that the wear table lacks.
std::string kosanam_set_up(const std::string& model, const BatchOptions& batch, double health_variance,
                           const std::vector<std::string>& not_known);

}  // namespace ehm::tuner_design::report
