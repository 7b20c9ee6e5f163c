// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/scenario/linear_model_file.h"

#include "deploy/runtime/config/schema.h"
#include "engine_sim/linear_model/discretise.h"
#include "engine_sim/linear_model/model_file.h"

namespace ehm::engine_sim {

std::shared_ptr<const linear_model::LinearModel> read_linear_model(const std::string& file) {
  try {
    return std::make_shared<const linear_model::LinearModel>(linear_model::discretise(linear_model::read_model(file)));
  } catch (const std::exception& e) {
    throw config::ConfigError(std::string("'linear.model': ") + e.what());
  }
}

}  // namespace ehm::engine_sim
