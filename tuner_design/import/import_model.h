// SPDX-License-Identifier: Apache-2.0
#pragma once
// A linear model from whatever a user has: our own JSON (linear_model/model_file.h), a MATLAB v5 file
// (mat_file.h), or a folder of CSV files (csv_folder.h). The last two may leave things unstated; assumptions are told.

#include <optional>
#include <string>
#include <vector>

#include "engine_sim/linear_model/linear_model.h"
#include "monitor/estimation/capacity.h"

namespace ehm::tuner_design {

/// Stand in for what a file does not state. One that is set although the file states it is an error, never ignored.
struct ImportOptions {
  std::optional<double> sample_time_s;          ///< of a continuous model's discretisation; no default
  std::optional<double> health_sigma_percent;   ///< spread over the fleet
  std::optional<double> sensor_noise_percent;   ///< of trim, standard deviation of one sample
  std::optional<double> process_noise_percent;  ///< of the states' trim, standard deviation of w per sample

  // The spread and the process noise of the reference case, theory.md, section 5; the noise lies within Simon & Garg's
  // table 2, which has 0.25 % (speeds), 0.5 % (pressures) and 0.75 % (temperatures).
  static constexpr double default_health_sigma_percent = 2.0;
  static constexpr double default_sensor_noise_percent = 0.5;
  static constexpr double default_process_noise_percent = 0.01;
};

struct ImportedModel {
  linear_model::LinearModel model;   ///< has passed linear_model::check_model
  std::string format;                ///< "ehm-linear-model/1", "MATLAB v5 file" or "CSV folder"
  std::vector<std::string> assumed;  ///< one sentence each; empty if everything was stated
};

/// True for what is not JSON: a folder, a MATLAB file, a CSV file (which is refused: a model is a folder of them).
bool is_foreign_model(const std::string& path);

/// For files that state everything themselves. @throws files::FileError if an option is set.
void refuse_import_options(const std::string& path, const ImportOptions& options);

/// @throws files::FileError (one message: file, what and where, allowed, what to do) for every defect.
/// `sensor_capacity`: candidates for a selection may be more than what flies.
ImportedModel import_model(const std::string& path, const ImportOptions& options,
                           int sensor_capacity = estimation::max_sensors);

}  // namespace ehm::tuner_design
