// SPDX-License-Identifier: Apache-2.0
#pragma once
// The linear model that engine_sim flies: the file that tuner_design reads and writes, linear_model/model_file.h.

#include <memory>
#include <string>

#include "engine_sim/linear_model/linear_model.h"

namespace ehm::engine_sim {

/// Discrete, as it is flown. @throws config::ConfigError naming file, key, value and what is allowed.
std::shared_ptr<const linear_model::LinearModel> read_linear_model(const std::string& file);

}  // namespace ehm::engine_sim
