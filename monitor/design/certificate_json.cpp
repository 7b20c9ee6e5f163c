// SPDX-License-Identifier: Apache-2.0
#include "monitor/design/certificate_json.h"

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/numbers/index.h"

namespace ehm::design {
namespace {

constexpr const char* make_again = "Make the design again with tuner_design design";

bool truth(files::JsonObject& object, const std::string& key) {
  const files::Json& value = object.at(key);
  if (!value.is_boolean())
    files::throw_defect(object.file(), object.key(key), files::shown(value), "true or false", make_again);
  return value.get<bool>();
}

int count(files::JsonObject& object, const std::string& key) {
  const files::Json& value = object.at(key);
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > 1'000'000'000)
    files::throw_defect(object.file(), object.key(key), files::shown(value), "an integer from 0 to 1000000000",
                        make_again);
  return value.get<int>();
}

/// A vector of whatever length the file gives.
Eigen::VectorXd any_vector(files::JsonObject& object, const std::string& key) {
  return object.vector(key, as_index(object.array(key).size()));
}

SearchStart start_from(const files::Json& json, const std::string& file, const std::string& path) {
  files::JsonObject object(json, file, path);
  SearchStart start;
  start.name = object.text("name");
  start.first = object.number("first");
  start.last = object.number("last");
  start.gradient_norm = object.number("gradient_norm");
  start.angle_rad = object.number("angle_rad");
  start.evaluations = count(object, "evaluations");
  object.refuse_unknown();
  return start;
}

CertifiedPoint point_from(const files::Json& json, const std::string& file, const std::string& path) {
  files::JsonObject object(json, file, path);
  CertifiedPoint point;
  point.model = object.text("model");
  point.weight = object.positive_number("weight");
  point.health_ratio = object.number("health_ratio");
  point.auxiliary_ratio = object.number("auxiliary_ratio");
  object.refuse_unknown();
  return point;
}

}  // namespace

files::Json certificate_to_json(const Certificate& certificate, const std::string& file) {
  files::Json starts = files::Json::array(), points = files::Json::array();
  for (const SearchStart& start : certificate.starts)
    starts.push_back({{"name", start.name},
                      {"first", start.first},
                      {"last", start.last},
                      {"gradient_norm", start.gradient_norm},
                      {"angle_rad", start.angle_rad},
                      {"evaluations", start.evaluations}});
  for (const CertifiedPoint& point : certificate.points)
    points.push_back({{"model", point.model},
                      {"weight", point.weight},
                      {"health_ratio", point.health_ratio},
                      {"auxiliary_ratio", point.auxiliary_ratio}});
  const auto vector = [&](const Eigen::VectorXd& values, const char* key) {
    return files::vector_to_json(values, file, std::string("certificate.") + key);
  };
  return {{"verdict", certificate.verdict},
          {"at_optimum", certificate.at_optimum},
          {"objective", certificate.objective},
          {"closed_form_objective", certificate.closed_form_objective},
          {"lower_bound", certificate.lower_bound},
          {"limit_is_prior", certificate.limit_is_prior},
          {"gradient_norm", certificate.gradient_norm},
          {"possible_gain", certificate.possible_gain},
          {"least_curvature", certificate.least_curvature},
          {"largest_curvature", certificate.largest_curvature},
          {"flat_directions", certificate.flat_directions},
          {"starts", std::move(starts)},
          {"points", std::move(points)},
          {"steady_singular_values", vector(certificate.steady_singular_values, "steady_singular_values")},
          {"pair_singular_values", vector(certificate.pair_singular_values, "pair_singular_values")},
          {"condition", certificate.condition},
          {"slow_bias_detectability", vector(certificate.slow_bias_detectability, "slow_bias_detectability")}};
}

Certificate certificate_from_json(const files::Json& json, const std::string& file) {
  files::JsonObject object(json, file, "certificate");
  Certificate certificate;
  certificate.verdict = object.text("verdict");
  certificate.at_optimum = truth(object, "at_optimum");
  certificate.objective = object.number("objective");
  certificate.closed_form_objective = object.number("closed_form_objective");
  certificate.lower_bound = object.number("lower_bound");
  certificate.limit_is_prior = truth(object, "limit_is_prior");
  certificate.gradient_norm = object.number("gradient_norm");
  certificate.possible_gain = object.number("possible_gain");
  certificate.least_curvature = object.number("least_curvature");
  certificate.largest_curvature = object.number("largest_curvature");
  certificate.flat_directions = count(object, "flat_directions");
  const files::Json &starts = object.array("starts"), &points = object.array("points");
  for (std::size_t i = 0; i < starts.size(); ++i)
    certificate.starts.push_back(start_from(starts[i], file, "certificate.starts[" + std::to_string(i) + "]"));
  for (std::size_t i = 0; i < points.size(); ++i)
    certificate.points.push_back(point_from(points[i], file, "certificate.points[" + std::to_string(i) + "]"));
  certificate.steady_singular_values = any_vector(object, "steady_singular_values");
  certificate.pair_singular_values = any_vector(object, "pair_singular_values");
  certificate.condition = object.positive_number("condition");
  if (object.find("slow_bias_detectability"))  // files of earlier versions do not tell it
    certificate.slow_bias_detectability = any_vector(object, "slow_bias_detectability");
  object.refuse_unknown();
  return certificate;
}

}  // namespace ehm::design
