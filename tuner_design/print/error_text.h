// SPDX-License-Identifier: Apache-2.0
#pragma once
// How errors by channel and single figures are written, the same in every report of the bench.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine_sim/linear_model/linear_model.h"

namespace ehm::tuner_design {

/// {"total": sum, "by_channel": {name: squared error}}
nlohmann::ordered_json errors_as_json(const Eigen::VectorXd& errors,
                                      const std::vector<linear_model::Channel>& channels);

/// Five significant digits, in a column.
std::string figure(double value, int width = 11);

}  // namespace ehm::tuner_design
