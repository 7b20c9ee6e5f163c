// SPDX-License-Identifier: Apache-2.0
#include "monitor/checkpoint/checkpoint.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/files/json_object.h"
#include "deploy/runtime/numbers/index.h"
#include "monitor/checkpoint/state_json.h"
#include "monitor/design/make_estimator.h"

namespace ehm::monitor {

namespace {

using files::Json;
using files::JsonObject;

Eigen::Index length(JsonObject& object, const std::string& name, int max) {
  const Json& value = object.array(name);
  if (value.empty() || value.size() > as_size(max))
    files::throw_defect(object.file(), object.key(name), std::to_string(value.size()) + " long",
                        "1 to " + std::to_string(max), state_json::remedy);
  return as_index(value.size());
}

/// As many columns as the first row has.
Eigen::MatrixXd matrix(JsonObject& object, const std::string& name, Eigen::Index rows, int max_columns) {
  const Json& first = object.array(name);
  const std::size_t columns = first.empty() || !first[0].is_array() ? 0 : first[0].size();
  if (columns > as_size(max_columns))
    files::throw_defect(object.file(), object.key(name), std::to_string(columns) + " columns wide",
                        "at most " + std::to_string(max_columns), state_json::remedy);
  return object.matrix(name, rows, as_index(columns));
}

Json error_to_json(const estimation::ErrorState& error) {
  return {{"remaining_samples", error.remaining},
          {"mean", files::to_json(error.mean, "checkpoint", "error.mean")},
          {"covariance", files::to_json(error.covariance, "checkpoint", "error.covariance")}};
}

estimation::ErrorState error_from_json(JsonObject& root, Eigen::Index augmented) {
  JsonObject object(root.at("error"), root.file(), root.key("error"));
  estimation::ErrorState error;
  error.remaining = state_json::integer(object, "remaining_samples", 0, std::numeric_limits<int>::max());
  error.mean = matrix(object, "mean", augmented, estimation::max_unknowns);
  error.covariance = object.matrix("covariance", augmented, augmented);
  object.refuse_unknown();
  state_json::require_moderate(object, "mean", error.mean);
  state_json::require_moderate(object, "covariance", error.covariance);
  state_json::require_covariance(object, error.covariance);
  return error;
}

/// Adds it to the keys of `json`.
void state_to_json(const estimation::EstimatorState& state, Json& json) {
  json["missing_sensor"] = state.missing_sensor;
  json["held_samples"] = state.held_samples;
  json["estimate"] = files::vector_to_json(state.estimate, "checkpoint", "estimate");
  json["error"] = error_to_json(state.error);
}

/// Adds what a constraint holds beside it.
void constrained_to_json(const estimation::ConstrainedState& state, Json& json) {
  if (state.bound.size() == 0) return;
  json["constrained"] = {
      {"bound", files::vector_to_json(state.bound, "checkpoint", "constrained.bound")},
      {"health", files::vector_to_json(state.health, "checkpoint", "constrained.health")},
      {"sigma_share", files::vector_to_json(state.sigma_share, "checkpoint", "constrained.sigma_share")}};
}

estimation::ConstrainedState constrained_from_json(JsonObject& root) {
  if (root.find("constrained") == nullptr) return {};
  JsonObject object(root.at("constrained"), root.file(), root.key("constrained"));
  estimation::ConstrainedState state;
  state.bound = object.vector("bound", length(object, "bound", estimation::max_health));
  state.health = object.vector("health", state.bound.size());
  state.sigma_share = object.vector("sigma_share", state.bound.size());
  object.refuse_unknown();
  for (const auto& [name, values] :
       {std::pair{"bound", &state.bound}, {"health", &state.health}, {"sigma_share", &state.sigma_share}})
    state_json::require_moderate(object, name, *values);
  return state;
}

estimation::EstimatorState state_from_json(JsonObject& object, bool has_hold) {
  estimation::EstimatorState state;
  state.missing_sensor = state_json::integer(object, "missing_sensor", -1, estimation::max_sensors - 1);
  if (has_hold)
    state.held_samples =
        state_json::integer<std::int64_t>(object, "held_samples", 0, std::numeric_limits<std::int32_t>::max());
  state.estimate = object.vector("estimate", length(object, "estimate", estimation::max_augmented));
  state_json::require_moderate(object, "estimate", state.estimate);
  state.error = error_from_json(object, state.estimate.size());
  return state;
}

Json companions_to_json(const std::vector<CompanionState>& companions) {
  Json json = Json::object();
  for (const auto& [name, state] : companions) {  // one that has no state to keep begins cold
    if (state.estimate.size() > 0) state_to_json(state, json[std::string(name)]);
    if (!state.learned.empty())
      json[std::string(name)]["learned"] = state_json::learned_to_json(state.learned, "checkpoint", "learned");
    if (json.contains(std::string(name))) constrained_to_json(state.constrained, json[std::string(name)]);
  }
  return json;
}

/// As long as the value that it states.
estimation::EstimatorState learned_state_from_json(JsonObject& object) {
  JsonObject learned(object.at("learned"), object.file(), object.key("learned"));
  estimation::EstimatorState state;
  state.learned = state_json::learned_from_json(object, "learned", length(learned, "value", estimation::max_learned));
  return state;
}

std::vector<CompanionState> companions_from_json(JsonObject& root) {
  JsonObject object(root.at("companions"), root.file(), root.key("companions"));
  std::vector<CompanionState> companions;
  for (const auto& [name, value] : root.at("companions").items()) {
    const std::string_view known = design::known_name(name);
    if (known.empty() || known == design::tuner_name)
      state_json::defect(root, "companions", name, "estimators beside the tuner filter, of " + design::known_names());
    JsonObject companion(object.at(name), root.file(), object.key(name));
    companions.push_back({known, companion.find("learned") != nullptr ? learned_state_from_json(companion)
                                                                      : state_from_json(companion, true)});
    companions.back().state.constrained = constrained_from_json(companion);
    companion.refuse_unknown();
  }
  return companions;
}

Json return_gate_to_json(const ReturnGate::Memory& memory) {
  return {{"offset", memory.offset},
          {"narrow_variance", memory.narrow_variance},
          {"wide_variance", memory.wide_variance},
          {"age_s", memory.age_s},
          {"bias", memory.bias}};
}

ReturnGate::Memory return_gate_from_json(JsonObject& root) {
  JsonObject object(root.at("return_gate"), root.file(), root.key("return_gate"));
  ReturnGate::Memory memory;
  memory.offset = object.number("offset");
  memory.narrow_variance = object.positive_number("narrow_variance");
  memory.wide_variance = object.positive_number("wide_variance");
  memory.age_s = object.number("age_s");
  memory.bias = object.number("bias");
  if (memory.age_s < 0.0) state_json::defect(object, "age_s", memory.age_s, "0 or more");
  object.refuse_unknown();
  return memory;
}

Json bias_return_to_json(const BiasReturn::Memory& memory) {
  return {{"sensor", memory.sensor}, {"mean", memory.mean}, {"largest", memory.largest}, {"least", memory.least}};
}

BiasReturn::Memory bias_return_from_json(JsonObject& root) {
  JsonObject object(root.at("bias_return"), root.file(), root.key("bias_return"));
  BiasReturn::Memory memory;
  memory.sensor = state_json::integer(object, "sensor", -1, estimation::max_sensors - 1);
  memory.mean = object.number("mean");
  memory.largest = object.number("largest");
  memory.least = object.number("least");
  if (memory.largest < 0.0) state_json::defect(object, "largest", memory.largest, "0 or more");
  if (memory.least < 0.0) state_json::defect(object, "least", memory.least, "0 or more");
  object.refuse_unknown();
  return memory;
}

estimation::SensorMask excluded_from_json(JsonObject& root) {
  const auto bits =
      state_json::integer<std::uint32_t>(root, "excluded_sensors", 0, (1u << estimation::max_sensors) - 1);
  return estimation::SensorMask(bits);
}

void read_source(JsonObject& root, CycleState& state) {
  JsonObject object(root.at("source"), root.file(), root.key("source"));
  state.source_id = state_json::integer<std::uint32_t>(object, "id", 0, std::numeric_limits<std::uint32_t>::max());
  state.sequence = state_json::integer<std::uint64_t>(object, "sequence", 0, std::numeric_limits<std::uint64_t>::max());
  state.source_time_ns = state_json::integer<std::int64_t>(object, "time_ns", std::numeric_limits<std::int64_t>::min(),
                                                           std::numeric_limits<std::int64_t>::max());
  object.refuse_unknown();
}

/// Schema and hash. @returns whether it is of a schema that has companions.
bool verify(JsonObject& root, Json content) {
  const std::string schema = root.text("schema");
  if (std::find(checkpoint_schemas.begin(), checkpoint_schemas.end(), schema) == checkpoint_schemas.end())
    state_json::defect(root, "schema", schema, std::string(checkpoint_schema) + ", or one of the versions before it");
  state_json::require_hash(root, std::move(content));
  return schema != checkpoint_schemas.front();
}

}  // namespace

std::string to_text(const Checkpoint& c) {
  const CycleState& s = c.state;
  Json json = {{"schema", checkpoint_schema},
               {"engine_id", c.engine_id},
               {"design", c.design_hash},
               {"wall_time_ns", c.wall_time_ns},
               {"source", {{"id", s.source_id}, {"sequence", s.sequence}, {"time_ns", s.source_time_ns}}},
               {"excluded_sensors", s.excluded.to_ulong()},
               {"return_gate", return_gate_to_json(s.return_gate)},
               {"bias_return", bias_return_to_json(s.bias_return)},
               {"companions", companions_to_json(s.companions)}};
  state_to_json(s.watch, json);
  return state_json::hashed_text(std::move(json));
}

Checkpoint parse_checkpoint(std::string_view text, const std::string& file) {
  const Json json = files::parse_json_text(std::string(text), file);
  JsonObject root(json, file, "");
  const bool has_companions = verify(root, json);
  Checkpoint c;
  c.engine_id = state_json::integer<std::uint32_t>(root, "engine_id", 1, std::numeric_limits<std::uint32_t>::max());
  c.design_hash = root.text("design");
  c.wall_time_ns = state_json::integer<std::int64_t>(root, "wall_time_ns", 0, std::numeric_limits<std::int64_t>::max());
  read_source(root, c.state);
  c.state.excluded = excluded_from_json(root);
  c.state.watch = state_from_json(root, has_companions);
  c.state.return_gate = return_gate_from_json(root);
  if (has_companions) c.state.companions = companions_from_json(root);
  if (root.find("bias_return") != nullptr) c.state.bias_return = bias_return_from_json(root);
  root.refuse_unknown();
  return c;
}

}  // namespace ehm::monitor
