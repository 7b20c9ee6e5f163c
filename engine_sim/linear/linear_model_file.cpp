#include "engine_sim/linear/linear_model_file.h"

#include "deploy/config/schema.h"
#include "monitor/design/model_file.h"
#include "monitor/estimation/discretise.h"

namespace ehm::engine {

std::shared_ptr<const estimation::LinearModel> read_linear_model(const std::string& file) {
  try {
    return std::make_shared<const estimation::LinearModel>(estimation::discretise(design::read_model(file)));
  } catch (const std::exception& e) {
    throw config::ConfigError(std::string("'linear.model': ") + e.what());
  }
}

double unit_of_health(const estimation::Channel& parameter) {
  return parameter.unit == "fraction" || parameter.unit == "-" ? 1.0 : 100.0;
}

}  // namespace ehm::engine
