// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/import/import_model.h"

#include <filesystem>

#include "deploy/runtime/files/file_error.h"
#include "engine_sim/linear_model/model_file.h"
#include "tuner_design/import/assemble_model.h"
#include "tuner_design/import/csv_folder.h"
#include "tuner_design/import/mat_file.h"

namespace ehm::tuner_design {
namespace {

bool is_folder(const std::string& path) {
  std::error_code absent;
  return std::filesystem::is_directory(path, absent);
}

bool is_csv_file(const std::string& path) {
  return std::filesystem::path(path).extension() == ".csv";
}

/// Our own file states everything.
ImportedModel import_json(const std::string& path, const ImportOptions& options, int sensor_capacity) {
  refuse_import_options(path, options);
  return {linear_model::read_model(path, sensor_capacity), linear_model::model_schema, {}};
}

}  // namespace

bool is_foreign_model(const std::string& path) {
  return is_folder(path) || is_mat_file(path) || is_csv_file(path);
}

void refuse_import_options(const std::string& path, const ImportOptions& options) {
  if (options.sample_time_s || options.health_sigma_percent || options.sensor_noise_percent ||
      options.process_noise_percent) {
    throw files::FileError(path +
                           ": states sample time, health sigma and noise itself; --sample-time, --health-sigma, "
                           "--sensor-noise and --process-noise are for files that do not. Remove them.");
  }
}

ImportedModel import_model(const std::string& path, const ImportOptions& options, int sensor_capacity) {
  if (is_folder(path)) return assemble_model(read_csv_folder(path), options, sensor_capacity);
  if (is_mat_file(path)) return assemble_model(read_mat_file(path), options, sensor_capacity);
  if (is_csv_file(path)) {
    throw files::FileError(path + ": is one matrix; allowed: a folder of them. Name the folder with A.csv, L.csv, ...");
  }
  return import_json(path, options, sensor_capacity);
}

}  // namespace ehm::tuner_design
