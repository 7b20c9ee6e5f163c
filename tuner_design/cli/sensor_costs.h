// SPDX-License-Identifier: Apache-2.0
#pragma once
// What each candidate sensor costs, from the command line. Cost is in any unit the user likes; 1 where nothing is said.
//   NAME=VALUE   one sensor        FILE   CSV with the columns sensor, cost

#include <string>
#include <vector>

#include "engine_sim/linear_model/linear_model.h"

namespace ehm::tuner_design {

/// Position of the sensor in the model. @throws files::FileError naming `place` and the sensors that there are.
std::size_t sensor_index(const std::vector<linear_model::Channel>& sensors, const std::string& name,
                         const std::string& place);

/// `texts` in the order of the command line; what comes later wins over what came before.
/// @throws files::FileError for an unknown sensor, a value that is no number or negative, a column that is missing or
///         unknown, and a sensor that one file names twice.
std::vector<double> sensor_costs(const std::vector<linear_model::Channel>& sensors,
                                 const std::vector<std::string>& texts);

}  // namespace ehm::tuner_design
