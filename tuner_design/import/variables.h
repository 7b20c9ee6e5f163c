// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a user's file or folder states, by name, before it becomes a LinearModel; every format is read into this.
// The names are those of the table in deploy/docs/own_engine.md, "Names".

#include <Eigen/Core>
#include <array>
#include <map>
#include <string>
#include <vector>

namespace ehm::tuner_design {

/// What they are: engine_sim/linear_model/linear_model.h; Q and R are covariances per sample.
inline constexpr std::array matrix_variables{"A", "B", "L", "C", "D", "M",
                                             "F", "G", "N", "Q", "R", "linearisation_error"};
/// Ts as MATLAB has it: 0 continuous, -1 discrete with an unstated sample time.
inline constexpr std::array scalar_variables{"Ts", "sample_time_s", "altitude_m", "mach", "delta_isa_k"};
inline constexpr std::array vector_variables{"state_trim",        "control_trim",           "health_trim",
                                             "sensor_trim",       "auxiliary_trim",         "sensor_noise_sigma",
                                             "sensor_resolution", "sensor_update_period_s", "health_sigma"};
inline constexpr std::array text_variables{"name",          "engine_type",   "state_names",     "state_units",
                                           "control_names", "control_units", "health_names",    "health_units",
                                           "sensor_names",  "sensor_units",  "auxiliary_names", "auxiliary_units"};

template <std::size_t N>
bool contains(const std::array<const char*, N>& names, const std::string& name) {
  for (const char* known : names) {
    if (name == known) return true;
  }
  return false;
}

struct Variables {
  std::string path;                                ///< the file or folder
  std::string source;                              ///< the same as messages name it: with the structure inside the file
  std::string format;                              ///< as outputs name it: "MATLAB v5 file"
  std::map<std::string, Eigen::MatrixXd> numbers;  ///< finite; NaN in a vector variable: not stated for this channel
  std::map<std::string, std::vector<std::string>> texts;  ///< an empty text: not stated for this channel
  std::vector<std::string> ignored;                       ///< what else stands there

  [[nodiscard]] const Eigen::MatrixXd* find(const std::string& name) const {
    const auto it = numbers.find(name);
    return it == numbers.end() ? nullptr : &it->second;
  }
};

}  // namespace ehm::tuner_design
