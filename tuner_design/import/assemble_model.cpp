// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/import/assemble_model.h"

#include <filesystem>

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/files/json_object.h"
#include "engine_sim/linear_model/model_check.h"
#include "tuner_design/import/assemble_channels.h"
#include "tuner_design/import/assemble_matrices.h"
#include "tuner_design/import/assemble_noise.h"

namespace ehm::tuner_design {
namespace {

using files::shown;
using files::throw_defect;
using linear_model::LinearModel;

std::optional<double> scalar(const Variables& given, const std::string& name) {
  const Eigen::MatrixXd* value = given.find(name);
  if (value == nullptr || value->size() == 0) return std::nullopt;
  if (value->size() == 1) return (*value)(0, 0);
  throw_defect(given.source, name, std::to_string(value->rows()) + " x " + std::to_string(value->cols()), "one number",
               "Give one");
}

std::string text(const Variables& given, const std::string& name) {
  const auto it = given.texts.find(name);
  if (it == given.texts.end() || it->second.empty()) return "";
  if (it->second.size() == 1) return it->second.front();
  throw_defect(given.source, name, std::to_string(it->second.size()) + " texts", "one text", "Give one");
}

void assemble_time(const Variables& given, const ImportOptions& options, ImportedModel& result) {
  LinearModel& model = result.model;
  const double period = scalar(given, "Ts").value_or(0.0);
  if (period < 0.0 && period != -1.0)
    throw_defect(given.source, "Ts", shown(period), "0 (continuous), -1 or above 0 (discrete)", "Give the sample time");
  std::optional<double> stated = scalar(given, "sample_time_s");
  if (period > 0.0 && stated && *stated != period) {
    throw_defect(given.source, "sample_time_s", shown(*stated), "Ts = " + shown(period) + " of the discrete model",
                 "Remove one of the two; a discrete model keeps its sample time");
  }
  if (period > 0.0) stated = period;
  if (stated && options.sample_time_s) refuse_option(given, "the sample time", "--sample-time");
  if (!stated && !options.sample_time_s) {
    throw files::FileError(given.source + ": the sample time is missing. Give the variable " +
                           (period < 0.0 ? "Ts" : "sample_time_s (continuous model) or Ts (discrete model)") +
                           ", or --sample-time, in seconds.");
  }
  model.discrete = period != 0.0;
  model.sample_time_s = stated ? *stated : *options.sample_time_s;
  if (given.find("Ts") == nullptr) result.assumed.emplace_back("continuous time, since Ts is not stated");
}

void assemble_operating_point(const Variables& given, ImportedModel& result) {
  const auto altitude = scalar(given, "altitude_m"), mach = scalar(given, "mach"), isa = scalar(given, "delta_isa_k");
  if (!altitude && !mach && !isa) return;
  if (!altitude || !mach) {
    throw files::FileError(given.source + ": " + (altitude ? "mach" : "altitude_m") +
                           " is missing; an operating point is altitude_m, mach and delta_isa_k. Add it.");
  }
  if (!isa) result.assumed.emplace_back("delta_isa_k: 0, since it is not stated");
  result.model.operating_point = {*altitude, *mach, isa.value_or(0.0)};
}

}  // namespace

ImportedModel assemble_model(const Variables& given, const ImportOptions& options, int sensor_capacity) {
  ImportedModel result;
  result.format = given.format;
  LinearModel& model = result.model;
  model.name = text(given, "name");
  if (model.name.empty()) model.name = std::filesystem::weakly_canonical(given.path).stem().string();
  model.engine_type = text(given, "engine_type");
  assemble_matrices(given, result);
  assemble_channels(given, result);
  assemble_time(given, options, result);
  assemble_noise(given, options, result);
  assemble_operating_point(given, result);
  if (const Eigen::MatrixXd* error = given.find("linearisation_error")) model.linearisation_error = *error;
  if (!given.ignored.empty()) {
    std::string names;
    for (const std::string& name : given.ignored) names += (names.empty() ? "" : ", ") + name;
    result.assumed.push_back("not part of a model, ignored: " + names);
  }
  linear_model::check_model(model, given.source, sensor_capacity);
  return result;
}

}  // namespace ehm::tuner_design
