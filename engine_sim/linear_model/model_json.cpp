// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/linear_model/model_json.h"

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/model_check.h"
#include "engine_sim/linear_model/model_file.h"
#include "engine_sim/linear_model/sensor_noise.h"

namespace ehm::linear_model {
namespace {

/// Channels of one list; `sigma_key` (or nullptr) is the standard deviation that each of them carries.
std::vector<Channel> read_channels(files::JsonObject& object, const std::string& list, const char* sigma_key,
                                   Eigen::VectorXd* sigma) {
  const files::Json& array = object.array(list);
  std::vector<Channel> channels;
  if (sigma != nullptr) sigma->resize(as_index(array.size()));
  for (std::size_t i = 0; i < array.size(); ++i) {
    files::JsonObject entry(array[i], object.file(), object.key(list) + "[" + std::to_string(i) + "]");
    Channel channel;
    channel.name = entry.text("name");
    channel.unit = entry.text("unit");
    const bool trim_is_optional = list == "health";
    if (!trim_is_optional || entry.find("trim") != nullptr) channel.trim = entry.number("trim");
    if (sigma_key != nullptr) (*sigma)(as_index(i)) = entry.number(sigma_key);
    if (list == "sensors") entry.find("resolution"), entry.find("update_period_s");  // read_optional's
    entry.refuse_unknown();
    channels.push_back(std::move(channel));
  }
  return channels;
}

/// What each sensor may state of itself; empty where none does. @returns its values, 0 where it does not.
Eigen::VectorXd read_optional(files::JsonObject& object, const std::string& list, const char* key) {
  const files::Json& array = object.array(list);
  Eigen::VectorXd values = Eigen::VectorXd::Zero(as_index(array.size()));
  for (std::size_t i = 0; i < array.size(); ++i) {
    files::JsonObject entry(array[i], object.file(), object.key(list) + "[" + std::to_string(i) + "]");
    if (entry.find(key) != nullptr) values(as_index(i)) = entry.positive_number(key);
  }
  return values.isZero(0.0) ? Eigen::VectorXd() : values;
}

/// The file has the noise before rounding, and as of a sensor that speaks at each sample.
void read_sensors(files::JsonObject& object, LinearModel& model) {
  model.sensors = read_channels(object, "sensors", "noise_sigma", &model.sensor_noise_sigma);
  model.sensor_resolution = read_optional(object, "sensors", "resolution");
  model.sensor_update_period_s = read_optional(object, "sensors", "update_period_s");
  for (Eigen::Index i = 0; i < model.sensor_noise_sigma.size(); ++i)
    model.sensor_noise_sigma(i) = counted_sigma(model, i, model.sensor_noise_sigma(i));
}

files::Json channels_to_json(const std::vector<Channel>& channels, const char* sigma_key,
                             const Eigen::VectorXd* sigma) {
  files::Json array = files::Json::array();
  for (std::size_t i = 0; i < channels.size(); ++i) {
    files::Json entry{{"name", channels[i].name}, {"unit", channels[i].unit}, {"trim", channels[i].trim}};
    if (sigma_key != nullptr) entry[sigma_key] = (*sigma)(as_index(i));
    array.push_back(std::move(entry));
  }
  return array;
}

files::Json sensors_to_json(const LinearModel& model) {
  Eigen::VectorXd sigma = model.sensor_noise_sigma;
  for (Eigen::Index i = 0; i < sigma.size(); ++i) sigma(i) = own_sigma(model, i);
  files::Json array = channels_to_json(model.sensors, "noise_sigma", &sigma);
  const std::pair<const char*, const Eigen::VectorXd*> optional[] = {
      {"resolution", &model.sensor_resolution}, {"update_period_s", &model.sensor_update_period_s}};
  for (const auto& [key, values] : optional)
    for (Eigen::Index i = 0; i < values->size(); ++i)
      if ((*values)(i) > 0.0) array[as_size(i)][key] = (*values)(i);
  return array;
}

bool read_time(files::JsonObject& object) {
  const std::string time = object.text("time");
  if (time != "continuous" && time != "discrete") {
    files::throw_defect(object.file(), object.key("time"), "\"" + time + "\"", "\"continuous\" or \"discrete\"",
                        "Say which form the matrices have");
  }
  return time == "discrete";
}

void read_matrices(files::JsonObject& object, LinearModel& model) {
  const auto n = as_index(model.states.size()), nu = as_index(model.controls.size());
  const auto p = as_index(model.health.size()), m = as_index(model.sensors.size());
  const auto r = as_index(model.auxiliary.size());
  model.A = object.matrix("A", n, n);
  model.B = object.matrix("B", n, nu);
  model.L = object.matrix("L", n, p);
  model.C = object.matrix("C", m, n);
  model.D = object.matrix("D", m, nu);
  model.M = object.matrix("M", m, p);
  model.F = object.matrix("F", r, n);
  model.G = object.matrix("G", r, nu);
  model.N = object.matrix("N", r, p);
  model.process_noise = object.matrix("process_noise", n, n);
  if (object.find("linearisation_error") != nullptr) {
    model.linearisation_error = object.matrix("linearisation_error", m + r, m + r);
  }
}

}  // namespace

LinearModel model_from_json(const files::Json& json, const std::string& file, const std::string& path,
                            int sensor_capacity) {
  files::JsonObject object(json, file, path);
  const std::string schema = object.text("schema");
  if (schema != model_schema) {
    files::throw_defect(file, object.key("schema"), "\"" + schema + "\"", std::string("\"") + model_schema + "\"",
                        "Convert the file to this format");
  }
  LinearModel model;
  model.name = object.text("name");
  model.discrete = read_time(object);
  model.sample_time_s = object.positive_number("sample_time_s");
  if (object.find("engine_type") != nullptr) model.engine_type = object.text("engine_type");
  if (object.find("engine_hash") != nullptr) model.engine_hash = object.text("engine_hash");
  if (const files::Json* point = object.find("operating_point")) {
    files::JsonObject entry(*point, file, object.key("operating_point"));
    model.operating_point = {entry.number("altitude_m"), entry.number("mach"), entry.number("delta_isa_k")};
    entry.refuse_unknown();
  }
  model.states = read_channels(object, "states", nullptr, nullptr);
  model.controls = read_channels(object, "controls", nullptr, nullptr);
  model.health = read_channels(object, "health", "sigma", &model.health_sigma);
  read_sensors(object, model);
  model.auxiliary = read_channels(object, "auxiliary", nullptr, nullptr);
  read_matrices(object, model);
  object.refuse_unknown();
  check_model(model, file, sensor_capacity);
  return model;
}

files::Json model_to_json(const LinearModel& model, const std::string& file) {
  check_model(model, file);
  files::Json json{{"schema", model_schema},
                   {"name", model.name},
                   {"time", model.discrete ? "discrete" : "continuous"},
                   {"sample_time_s", model.sample_time_s},
                   {"states", channels_to_json(model.states, nullptr, nullptr)},
                   {"controls", channels_to_json(model.controls, nullptr, nullptr)},
                   {"health", channels_to_json(model.health, "sigma", &model.health_sigma)},
                   {"sensors", sensors_to_json(model)},
                   {"auxiliary", channels_to_json(model.auxiliary, nullptr, nullptr)},
                   {"process_noise", files::to_json(model.process_noise, file, "process_noise")}};
  if (!model.engine_type.empty()) json["engine_type"] = model.engine_type;
  if (!model.engine_hash.empty()) json["engine_hash"] = model.engine_hash;
  if (model.operating_point) {
    json["operating_point"] = {{"altitude_m", model.operating_point->altitude_m},
                               {"mach", model.operating_point->mach},
                               {"delta_isa_k", model.operating_point->delta_isa_k}};
  }
  if (model.linearisation_error.size() > 0) {
    json["linearisation_error"] = files::to_json(model.linearisation_error, file, "linearisation_error");
  }
  const std::pair<const char*, const Eigen::MatrixXd*> matrices[] = {{"A", &model.A}, {"B", &model.B}, {"L", &model.L},
                                                                     {"C", &model.C}, {"D", &model.D}, {"M", &model.M},
                                                                     {"F", &model.F}, {"G", &model.G}, {"N", &model.N}};
  for (const auto& [key, matrix] : matrices) json[key] = files::to_json(*matrix, file, key);
  return json;
}

}  // namespace ehm::linear_model
