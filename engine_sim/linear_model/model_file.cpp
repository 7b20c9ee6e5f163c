// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/linear_model/model_file.h"

#include "deploy/runtime/files/atomic_file.h"
#include "deploy/runtime/files/json_text.h"
#include "engine_sim/linear_model/model_json.h"

namespace ehm::linear_model {

LinearModel read_model(const std::string& path, int sensor_capacity) {
  return model_from_json(files::parse_json_file(path), path, "", sensor_capacity);
}

void write_model(const LinearModel& model, const std::string& path) {
  files::write_file_atomically(path, files::readable_text(model_to_json(model, path)));
}

}  // namespace ehm::linear_model
