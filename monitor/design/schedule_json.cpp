// SPDX-License-Identifier: Apache-2.0
#include "monitor/design/schedule_json.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "deploy/runtime/files/file_error.h"
#include "monitor/schedule/point_lookup.h"

namespace ehm::design {
namespace {

using files::Json;
using files::JsonObject;
using schedule::Node;
using schedule::Schedule;
using schedule::Similarity;

constexpr const char* remedy = "Make the design again with tuner_design envelope";

Json powers_to_json(const std::vector<Similarity>& channels) {
  Json json = Json::array();
  for (const Similarity& s : channels) json.push_back({s.delta_power, s.theta_power});
  return json;
}

std::vector<Similarity> powers_from_json(JsonObject& root, const std::string& key, std::size_t count) {
  const Eigen::MatrixXd powers = root.matrix(key, as_index(count), 2);
  std::vector<Similarity> channels;
  for (Eigen::Index i = 0; i < powers.rows(); ++i) channels.push_back({powers(i, 0), powers(i, 1)});
  return channels;
}

Json node_to_json(const Node& n, const std::string& file, const std::string& key) {
  if (!n.valid) return nullptr;
  const auto vector = [&](const char* name, const Eigen::VectorXd& v) {
    return files::vector_to_json(v, file, key + "." + name);
  };
  const auto matrix = [&](const char* name, const Eigen::MatrixXd& m) {
    return files::to_json(m, file, key + "." + name);
  };
  return {{"x0", vector("x0", n.x0)},
          {"u0", vector("u0", n.u0)},
          {"y0", vector("y0", n.y0)},
          {"z0", vector("z0", n.z0)},
          {"A", matrix("A", n.A)},
          {"B", matrix("B", n.B)},
          {"L", matrix("L", n.L)},
          {"C", matrix("C", n.C)},
          {"D", matrix("D", n.D)},
          {"M", matrix("M", n.M)},
          {"F", matrix("F", n.F)},
          {"G", matrix("G", n.G)},
          {"N", matrix("N", n.N)},
          {"lambda_x", vector("lambda_x", n.lambda_x)},
          {"lambda_y", vector("lambda_y", n.lambda_y)},
          {"lambda_z", vector("lambda_z", n.lambda_z)}};
}

Node node_from_json(const Json& value, const linear_model::LinearModel& model, const std::string& file,
                    const std::string& key) {
  if (value.is_null()) return {};
  const auto n = as_index(model.states.size()), u = as_index(model.controls.size()), h = as_index(model.health.size()),
             m = as_index(model.sensors.size()), r = as_index(model.auxiliary.size());
  JsonObject o(value, file, key);
  Node node{true,
            o.vector("x0", n),
            o.vector("u0", u),
            o.vector("y0", m),
            o.vector("z0", r),
            o.matrix("A", n, n),
            o.matrix("B", n, u),
            o.matrix("L", n, h),
            o.matrix("C", m, n),
            o.matrix("D", m, u),
            o.matrix("M", m, h),
            o.matrix("F", r, n),
            o.matrix("G", r, u),
            o.matrix("N", r, h),
            o.vector("lambda_x", n),
            o.vector("lambda_y", m),
            o.vector("lambda_z", r)};
  o.refuse_unknown();
  return node;
}

schedule::Axis axis_from_json(const Json& value, const std::string& file, const std::string& key) {
  JsonObject o(value, file, key);
  const std::string name = o.text("variable");
  const auto known = std::find(std::begin(schedule::variable_names), std::end(schedule::variable_names), name);
  if (known == std::end(schedule::variable_names))
    files::throw_defect(file, o.key("variable"), name, "n1_corrected_rpm, mach, t2_k or altitude_m", remedy);
  const Eigen::VectorXd points = o.vector("points", as_index(o.array("points").size()));
  o.refuse_unknown();
  return {static_cast<schedule::Variable>(known - std::begin(schedule::variable_names)),
          {points.data(), points.data() + points.size()}};
}

}  // namespace

Json schedule_to_json(const Schedule& s, const std::string& file) {
  Json axes = Json::array(), nodes = Json::array();
  for (const schedule::Axis& axis : s.axes)
    axes.push_back(
        {{"variable", schedule::variable_names[as_size(static_cast<int>(axis.variable))]}, {"points", axis.points}});
  for (std::size_t i = 0; i < s.nodes.size(); ++i)
    nodes.push_back(node_to_json(s.nodes[i], file, "schedule.nodes[" + std::to_string(i) + "]"));
  return {{"axes", axes},
          {"similarity",
           {{"states", powers_to_json(s.states)},
            {"actuators", powers_to_json(s.actuators)},
            {"sensors", powers_to_json(s.sensors)},
            {"auxiliary", powers_to_json(s.auxiliary)}}},
          {"reduced", s.reduced},
          {"fan_speed_state", s.fan_speed_state},
          {"eta_sensors", files::vector_to_json(s.eta_y, file, "schedule.eta_sensors")},
          {"eta_auxiliary", files::vector_to_json(s.eta_z, file, "schedule.eta_auxiliary")},
          {"path_n1_rpm", s.path_n1_rpm},
          {"path_mach", s.path_mach},
          {"bias_factor", s.bias_factor},
          {"nodes", nodes}};
}

Schedule schedule_from_json(const Json& value, const linear_model::LinearModel& model, const std::string& file) {
  JsonObject root(value, file, "schedule");
  Schedule s;
  std::size_t k = 0;
  for (const Json& axis : root.array("axes"))
    s.axes.push_back(axis_from_json(axis, file, "schedule.axes[" + std::to_string(k++) + "]"));
  JsonObject similarity(root.at("similarity"), file, "schedule.similarity");
  s.states = powers_from_json(similarity, "states", model.states.size());
  s.actuators = powers_from_json(similarity, "actuators", model.controls.size());
  s.sensors = powers_from_json(similarity, "sensors", model.sensors.size());
  s.auxiliary = powers_from_json(similarity, "auxiliary", model.auxiliary.size());
  similarity.refuse_unknown();
  const Json& reduced = root.at("reduced");
  if (!reduced.is_boolean())
    files::throw_defect(file, "schedule.reduced", files::shown(reduced), "true or false", remedy);
  s.reduced = reduced.get<bool>();
  const double state = root.number("fan_speed_state");
  if (!(state >= 0.0) || state >= static_cast<double>(model.states.size()))
    files::throw_defect(file, "schedule.fan_speed_state", files::shown(state), "the number of a state", remedy);
  s.fan_speed_state = static_cast<int>(state);
  s.eta_y = root.vector("eta_sensors", as_index(model.sensors.size()));
  s.eta_z = root.vector("eta_auxiliary", as_index(model.auxiliary.size()));
  s.path_n1_rpm = root.positive_number("path_n1_rpm");
  s.path_mach = root.positive_number("path_mach");
  s.bias_factor = root.positive_number("bias_factor");
  std::size_t i = 0;
  for (const Json& node : root.array("nodes"))
    s.nodes.push_back(node_from_json(node, model, file, "schedule.nodes[" + std::to_string(i++) + "]"));
  root.refuse_unknown();
  try {
    const schedule::PointLookup fits(s);
  } catch (const std::invalid_argument& error) {
    throw files::FileError(file + ": " + error.what() + ". " + remedy + ".");
  }
  return s;
}

}  // namespace ehm::design
