// SPDX-License-Identifier: Apache-2.0
#include "monitor/design/subset_json.h"

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"
#include "monitor/design/closed_loop.h"
#include "monitor/estimation/linear/lyapunov.h"
#include "monitor/estimation/linear/solver_error.h"

namespace ehm::design {
namespace {

std::vector<int> read_sensors(files::JsonObject& object, std::size_t count) {
  std::vector<int> sensors;
  for (const files::Json& value : object.array("sensors")) {
    const bool ascends = value.is_number_integer() && value.get<long long>() >= 0 &&
                         value.get<unsigned long long>() < count &&
                         (sensors.empty() || value.get<int>() > sensors.back());
    if (!ascends) {
      files::throw_defect(object.file(), object.key("sensors"), files::shown(object.at("sensors")),
                          "ascending indices below " + std::to_string(count),
                          "Make the design again with tuner_design design");
    }
    sensors.push_back(value.get<int>());
  }
  return sensors;
}

void check_variances(const Eigen::MatrixXd& covariance, const std::string& key, const std::string& file) {
  if (covariance.size() == 0 || covariance.diagonal().minCoeff() >= 0.0) return;
  files::throw_defect(file, key, "a matrix with the variance " + files::shown(covariance.diagonal().minCoeff()),
                      "variances of 0 or more", "Make the design again with tuner_design design");
}

void check_closed_loop(const SubsetDesign& design, const std::string& key, const std::string& file) {
  const double radius = estimation::spectral_radius(closed_loop(design));
  if (radius < 1.0) return;
  files::throw_defect(file, key, "a gain whose closed loop has the spectral radius " + files::shown(radius), "below 1",
                      "Make the design again with tuner_design design");
}

/// What the detectors divide by: the noise of the tuners' estimates. Of a closed loop that is stable.
void check_tuner_noise(const SubsetDesign& design, const linear_model::LinearModel& scaled, const std::string& key,
                       const std::string& file) {
  std::string fault = "a gain that leaves a combination of tuners without noise";
  try {
    const Eigen::LLT<Eigen::MatrixXd> factor(tuner_noise(design, scaled));
    if (factor.info() == Eigen::Success) return;
  } catch (const estimation::SolverError& error) {
    fault = std::string("a gain whose noise cannot be told (") + error.what() + ")";
  }
  files::throw_defect(file, key, fault, "gains by which noise reaches every tuner",
                      "Make the design again with tuner_design design");
}

/// Where a file states none, published health and outputs are read off as the filter models them.
void read_read_out(files::JsonObject& object, const linear_model::LinearModel& scaled, SubsetDesign& design) {
  const Eigen::Index t = design.V.rows();
  design.health_readout = design.W;
  design.auxiliary_readout = scaled.N * design.W;
  if (object.find("health_readout") != nullptr)
    design.health_readout = object.matrix("health_readout", design.W.rows(), t);
  if (object.find("auxiliary_readout") != nullptr)
    design.auxiliary_readout = object.matrix("auxiliary_readout", scaled.N.rows(), t);
}

}  // namespace

SubsetDesign subset_from_json(const files::Json& json, const linear_model::LinearModel& model,
                              const linear_model::Scaling& scaling, const std::string& file, const std::string& path) {
  const Eigen::Index n = model.A.rows(), nu = model.B.cols(), p = model.L.cols(), m = model.C.rows(),
                     r = model.F.rows();
  const linear_model::LinearModel scaled = linear_model::scaled(model, scaling);
  files::JsonObject object(json, file, path);
  SubsetDesign design;
  design.sensors = read_sensors(object, model.sensors.size());
  const auto t = as_index(object.array("V").size());
  if (t < 1 || t > std::min(m, p)) {
    files::throw_defect(file, object.key("V"), std::to_string(t) + " rows high",
                        "1 to " + std::to_string(std::min(m, p)) + " rows",
                        "Make the design again with tuner_design design");
  }
  design.V = object.matrix("V", t, p);
  design.W = object.matrix("W", p, t);
  read_read_out(object, scaled, design);
  design.A = object.matrix("A", n + t, n + t);
  design.B = object.matrix("B", n + t, nu);
  design.C = object.matrix("C", m, n + t);
  design.K = object.matrix("K", n + t, m);
  design.P = object.matrix("P", n + t, n + t);
  design.innovation_variance = object.vector("innovation_variance", m);
  design.slowest_time_constant_s = object.positive_number("slowest_time_constant_s");
  const std::pair<const char*, Eigen::MatrixXd*> covariances[] = {
      {"health_total_covariance", &design.health_total_covariance},
      {"auxiliary_total_covariance", &design.auxiliary_total_covariance},
      {"health_linearisation_covariance", &design.health_linearisation_covariance},
      {"auxiliary_linearisation_covariance", &design.auxiliary_linearisation_covariance},
      {"health_filter_covariance", &design.health_filter_covariance},
      {"auxiliary_filter_covariance", &design.auxiliary_filter_covariance},
      {"health_noise_covariance", &design.health_noise_covariance},
      {"auxiliary_noise_covariance", &design.auxiliary_noise_covariance}};
  for (const auto& [name, covariance] : covariances) {
    const Eigen::Index size = name[0] == 'h' ? p : r;
    *covariance = object.matrix(name, size, size);
    check_variances(*covariance, object.key(name), file);
  }
  object.refuse_unknown();
  check_closed_loop(design, object.key("K"), file);
  check_tuner_noise(design, scaled, object.key("K"), file);
  return design;
}

files::Json subset_to_json(const SubsetDesign& design, bool own_readout, const std::string& file,
                           const std::string& path) {
  files::Json json{{"sensors", design.sensors}, {"slowest_time_constant_s", design.slowest_time_constant_s}};
  json["innovation_variance"] = files::vector_to_json(design.innovation_variance, file, path + ".innovation_variance");
  const std::pair<const char*, const Eigen::MatrixXd*> matrices[] = {
      {"V", &design.V},
      {"W", &design.W},
      {"A", &design.A},
      {"B", &design.B},
      {"C", &design.C},
      {"K", &design.K},
      {"P", &design.P},
      {"health_total_covariance", &design.health_total_covariance},
      {"auxiliary_total_covariance", &design.auxiliary_total_covariance},
      {"health_linearisation_covariance", &design.health_linearisation_covariance},
      {"auxiliary_linearisation_covariance", &design.auxiliary_linearisation_covariance},
      {"health_filter_covariance", &design.health_filter_covariance},
      {"auxiliary_filter_covariance", &design.auxiliary_filter_covariance},
      {"health_noise_covariance", &design.health_noise_covariance},
      {"auxiliary_noise_covariance", &design.auxiliary_noise_covariance}};
  for (const auto& [name, matrix] : matrices) json[name] = files::to_json(*matrix, file, path + "." + name);
  if (own_readout) {
    json["health_readout"] = files::to_json(design.health_readout, file, path + ".health_readout");
    json["auxiliary_readout"] = files::to_json(design.auxiliary_readout, file, path + ".auxiliary_readout");
  }
  return json;
}

}  // namespace ehm::design
