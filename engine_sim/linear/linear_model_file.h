#pragma once
// The linear model that engine_sim flies: the file that tuner_design reads and writes (monitor/design/model_file.h).

#include <memory>
#include <string>

#include "monitor/estimation/linear_model.h"

namespace ehm::engine {

/// Discrete, as it is flown. @throws config::ConfigError naming file, key, value and what is allowed.
std::shared_ptr<const estimation::LinearModel> read_linear_model(const std::string& file);

/// One in the unit of a health parameter: 1 of a fraction, 100 of percent.
double unit_of_health(const estimation::Channel& parameter);

}  // namespace ehm::engine
