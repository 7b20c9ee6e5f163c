#include "monitor/design/model_file.h"

#include "deploy/files/atomic_file.h"
#include "monitor/design/json_text.h"
#include "monitor/design/model_json.h"

namespace ehm::design {

estimation::LinearModel read_model(const std::string& path, int sensor_capacity) {
  return model_from_json(parse_json_file(path), path, "", sensor_capacity);
}

void write_model(const estimation::LinearModel& model, const std::string& path) {
  files::write_file_atomically(path, readable_text(model_to_json(model, path)));
}

}  // namespace ehm::design
