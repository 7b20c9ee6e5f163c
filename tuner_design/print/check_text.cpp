// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/print/check_text.h"

#include <algorithm>
#include <ostream>

#include "deploy/runtime/files/content_hash.h"
#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/files/json_object.h"
#include "engine_sim/linear_model/discretise.h"
#include "engine_sim/linear_model/model_file.h"
#include "engine_sim/linear_model/model_json.h"
#include "engine_sim/linear_model/scaling.h"
#include "monitor/design/design_file.h"
#include "monitor/design/detectability.h"
#include "monitor/estimation/steady_gain.h"
#include "tuner_design/design/choose_tuners.h"
#include "tuner_design/design/tuner_number.h"
#include "tuner_design/print/certificate_text.h"

namespace ehm::tuner_design {
namespace {

using linear_model::LinearModel;

/// Augmented pair on the closed-form tuners: [A, L W; 0, I], [C, M W].
Eigen::VectorXd augmented_pair(const LinearModel& discrete, const Eigen::MatrixXd& H) {
  const Eigen::Index tuners = steady_observability(discrete, H).rank;
  const Eigen::MatrixXd R = discrete.sensor_noise_sigma.cwiseAbs2().asDiagonal();
  const Eigen::MatrixXd W =  // orthonormal rows: W = V^T
      closed_form_tuners(H, R, discrete.health_sigma, tuners).transpose();
  const Eigen::Index n = discrete.A.rows(), t = W.cols();
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(n + t, n + t);
  A.topLeftCorner(n, n) = discrete.A;
  A.topRightCorner(n, t) = discrete.L * W;
  Eigen::MatrixXd C(H.rows(), n + t);
  C << discrete.C, discrete.M * W;
  return pair_singular_values(A, C, discrete.sensor_noise_sigma);
}

std::string schema_of(const std::string& path) {
  const files::Json json = files::parse_json_file(path);
  files::JsonObject root(json, path, "");
  const std::string schema = root.text("schema");
  if (schema != linear_model::model_schema && schema != design::design_schema) {
    files::throw_defect(path, "schema", "\"" + schema + "\"",
                        std::string("\"") + linear_model::model_schema + "\" or \"" + design::design_schema + "\"",
                        "Give a linear model or a design made by this version");
  }
  return schema;
}

nlohmann::ordered_json values(const Eigen::VectorXd& vector) {
  return std::vector<double>(vector.begin(), vector.end());
}

}  // namespace

CheckedFile check_file(const std::string& path, const ImportOptions& options) {
  CheckedFile file;
  if (is_foreign_model(path) || schema_of(path) == linear_model::model_schema) {
    ImportedModel imported = import_model(path, options);
    file.kind = "linear model";
    file.schema = std::move(imported.format);
    file.model = std::move(imported.model);
    file.assumed = std::move(imported.assumed);
    file.hash = files::sha256_hex(linear_model::model_to_json(file.model, path).dump());
  } else {
    refuse_import_options(path, options);
    file.kind = "design";
    file.schema = design::design_schema;
    const design::Design design = design::read_design(path);
    file.model = design.model;
    file.hash = design.hash;
    file.slow_bias_detectability = design::slow_bias_detectability(design.model, design.scaling, design.full);
  }
  const LinearModel discrete = linear_model::scaled(discretise(file.model), linear_model::scaling_of(file.model));
  const estimation::SteadyGain steady = estimation::steady_gain(discrete);
  file.observability = steady_observability(discrete, steady.H);
  file.blind = blind_sensors(discrete, seeing_sensors({{discrete, {}, steady}}, all_sensors(discrete)));
  if (file.observability.rank > 0) file.pair_singular_values = augmented_pair(discrete, steady.H);
  return file;
}

void require_observable(const CheckedFile& file, const std::string& path) {
  try {
    require_observable(file.observability);
  } catch (const std::runtime_error& error) {
    throw files::FileError(path + ": " + error.what());
  }
}

nlohmann::ordered_json check_as_json(const CheckedFile& file) {
  const Observability& seen = file.observability;
  return {{"kind", file.kind},
          {"schema", file.schema},
          {"name", file.model.name},
          {"time", file.model.discrete ? "discrete" : "continuous"},
          {"sample_time_s", file.model.sample_time_s},
          {"states", file.model.states.size()},
          {"controls", file.model.controls.size()},
          {"health", file.model.health.size()},
          {"sensors", file.model.sensors.size()},
          {"auxiliary", file.model.auxiliary.size()},
          {"observable", seen.rank > 0},
          {"rank", seen.rank},
          {"needed_rank", seen.needed_rank},
          {"blind_sensors", file.blind},
          {"singular_values", values(seen.singular_values)},
          {"condition", seen.condition},
          {"pair_singular_values", values(file.pair_singular_values)},
          {"slow_bias_detectability", values(file.slow_bias_detectability)},
          {"assumed", file.assumed},
          {"hash", file.hash}};
}

void print_assumed(const std::vector<std::string>& assumed, std::ostream& out) {
  for (const std::string& assumption : assumed) out << "  assumed        " << assumption << '\n';
}

void print_blind(const std::vector<std::string>& blind, std::ostream& out) {
  for (const std::string& name : blind)
    out << "  blind sensor   " << name << " sees nothing of health in the steady state; no design uses it\n";
}

void print_check(const CheckedFile& file, std::ostream& out) {
  const LinearModel& model = file.model;
  const Observability& seen = file.observability;
  out << file.kind << " (" << file.schema << "), " << model.name << '\n'
      << "  time           " << (model.discrete ? "discrete" : "continuous") << ", sample " << model.sample_time_s
      << " s\n"
      << "  dimensions     " << model.states.size() << " states, " << model.controls.size() << " controls, "
      << model.health.size() << " health, " << model.sensors.size() << " sensors, " << model.auxiliary.size()
      << " auxiliary\n"
      << "  reduction      "
      << (model.sensors.size() < model.health.size() ? "needed: fewer sensors than health parameters"
                                                     : "none needed: V = I")
      << '\n'
      << "  observability  rank " << seen.rank << " of " << seen.needed_rank << ", condition " << seen.condition
      << "\n    singular values of R^-1/2 H Ph^1/2 (signal to noise):";
  for (const double value : seen.singular_values) out << ' ' << value;
  if (file.pair_singular_values.size() > 0) {
    out << "\n    singular values of the augmented pair:";
    for (const double value : file.pair_singular_values) out << ' ' << value;
  }
  out << '\n';
  const std::string note = rank_note(seen, model.sensors.size() < model.health.size());
  if (!note.empty()) out << "    " << note << '\n';
  print_blind(file.blind, out);
  print_detectability(model, file.slow_bias_detectability, out);
  out << "  hash           " << file.hash << '\n';
  print_assumed(file.assumed, out);
}

}  // namespace ehm::tuner_design
