// SPDX-License-Identifier: Apache-2.0
#include "monitor/checkpoint/checkpoint.h"

#include <limits>

#include "deploy/runtime/files/content_hash.h"
#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/files/json_object.h"
#include "deploy/runtime/numbers/index.h"

namespace ehm::monitor {

namespace {

using files::Json;
using files::JsonObject;

constexpr const char* remedy = "Remove the file; the monitor then starts cold and writes a new one";

[[noreturn]] void defect(const JsonObject& object, const std::string& name, const Json& value,
                         const std::string& allowed) {
  files::throw_defect(object.file(), object.key(name), files::shown(value), allowed, remedy);
}

template <class Integer>
Integer integer(JsonObject& object, const std::string& name, Integer min, Integer max) {
  const Json& value = object.at(name);
  const std::string allowed = std::to_string(min) + " to " + std::to_string(max);
  if (!value.is_number_integer()) defect(object, name, value, allowed);
  if (value.is_number_unsigned()) {
    const auto number = value.get<std::uint64_t>();
    if (number > static_cast<std::uint64_t>(max) || (min > 0 && number < static_cast<std::uint64_t>(min)))
      defect(object, name, value, allowed);
    return static_cast<Integer>(number);
  }
  const auto number = value.get<std::int64_t>();  // negative
  if (std::is_unsigned_v<Integer> || number < static_cast<std::int64_t>(min)) defect(object, name, value, allowed);
  return static_cast<Integer>(number);
}

Eigen::Index length(JsonObject& object, const std::string& name, int max) {
  const Json& value = object.array(name);
  if (value.empty() || value.size() > as_size(max))
    files::throw_defect(object.file(), object.key(name), std::to_string(value.size()) + " long",
                        "1 to " + std::to_string(max), remedy);
  return as_index(value.size());
}

/// As many columns as the first row has.
Eigen::MatrixXd matrix(JsonObject& object, const std::string& name, Eigen::Index rows, int max_columns) {
  const Json& first = object.array(name);
  const std::size_t columns = first.empty() || !first[0].is_array() ? 0 : first[0].size();
  if (columns > as_size(max_columns))
    files::throw_defect(object.file(), object.key(name), std::to_string(columns) + " columns wide",
                        "at most " + std::to_string(max_columns), remedy);
  return object.matrix(name, rows, as_index(columns));
}

/// A larger number is no state of any filter, and would make the next one infinite.
template <class Matrix>
void require_moderate(const JsonObject& object, const std::string& name, const Matrix& values) {
  constexpr double largest = 1e9;
  if (values.size() > 0 && values.cwiseAbs().maxCoeff() > largest)
    defect(object, name, values.cwiseAbs().maxCoeff(), "magnitudes up to " + files::shown(largest));
}

Json error_to_json(const estimation::ErrorState& error) {
  return {{"remaining_samples", error.remaining},
          {"mean", files::to_json(error.mean, "checkpoint", "error.mean")},
          {"covariance", files::to_json(error.covariance, "checkpoint", "error.covariance")}};
}

estimation::ErrorState error_from_json(JsonObject& root, Eigen::Index augmented) {
  JsonObject object(root.at("error"), root.file(), root.key("error"));
  estimation::ErrorState error;
  error.remaining = integer(object, "remaining_samples", 0, std::numeric_limits<int>::max());
  error.mean = matrix(object, "mean", augmented, estimation::max_unknowns);
  error.covariance = object.matrix("covariance", augmented, augmented);
  object.refuse_unknown();
  require_moderate(object, "mean", error.mean);
  require_moderate(object, "covariance", error.covariance);
  for (Eigen::Index i = 0; i < augmented; ++i)
    if (error.covariance(i, i) < 0.0)
      defect(object, "covariance[" + std::to_string(i) + "][" + std::to_string(i) + "]", error.covariance(i, i),
             "a variance, 0 or more");
  return error;
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
  if (memory.age_s < 0.0) defect(object, "age_s", memory.age_s, "0 or more");
  object.refuse_unknown();
  return memory;
}

estimation::SensorMask excluded_from_json(JsonObject& root) {
  const auto bits = integer<std::uint32_t>(root, "excluded_sensors", 0, (1u << estimation::max_sensors) - 1);
  return estimation::SensorMask(bits);
}

void read_source(JsonObject& root, CycleState& state) {
  JsonObject object(root.at("source"), root.file(), root.key("source"));
  state.source_id = integer<std::uint32_t>(object, "id", 0, std::numeric_limits<std::uint32_t>::max());
  state.sequence = integer<std::uint64_t>(object, "sequence", 0, std::numeric_limits<std::uint64_t>::max());
  state.source_time_ns = integer<std::int64_t>(object, "time_ns", std::numeric_limits<std::int64_t>::min(),
                                               std::numeric_limits<std::int64_t>::max());
  object.refuse_unknown();
}

void verify(JsonObject& root, Json content) {
  if (const std::string schema = root.text("schema"); schema != checkpoint_schema)
    defect(root, "schema", schema, std::string("\"") + checkpoint_schema + "\"");
  const std::string stated = root.text("hash");
  content.erase("hash");
  const std::string actual = files::sha256_hex(content.dump());
  if (stated != actual) defect(root, "hash", stated, "\"" + actual + "\", the SHA-256 of the content");
}

}  // namespace

std::string to_text(const Checkpoint& c) {
  const CycleState& s = c.state;
  Json json = {{"schema", checkpoint_schema},
               {"engine_id", c.engine_id},
               {"design", c.design_hash},
               {"wall_time_ns", c.wall_time_ns},
               {"source", {{"id", s.source_id}, {"sequence", s.sequence}, {"time_ns", s.source_time_ns}}},
               {"missing_sensor", s.missing_sensor},
               {"excluded_sensors", s.excluded.to_ulong()},
               {"estimate", files::vector_to_json(s.estimate, "checkpoint", "estimate")},
               {"error", error_to_json(s.error)},
               {"return_gate", return_gate_to_json(s.return_gate)}};
  json["hash"] = files::sha256_hex(json.dump());
  return json.dump() + "\n";
}

Checkpoint parse_checkpoint(std::string_view text, const std::string& file) {
  const Json json = files::parse_json_text(std::string(text), file);
  JsonObject root(json, file, "");
  verify(root, json);
  Checkpoint c;
  c.engine_id = integer<std::uint32_t>(root, "engine_id", 1, std::numeric_limits<std::uint32_t>::max());
  c.design_hash = root.text("design");
  c.wall_time_ns = integer<std::int64_t>(root, "wall_time_ns", 0, std::numeric_limits<std::int64_t>::max());
  read_source(root, c.state);
  c.state.missing_sensor = integer(root, "missing_sensor", -1, estimation::max_sensors - 1);
  c.state.excluded = excluded_from_json(root);
  c.state.estimate = root.vector("estimate", length(root, "estimate", estimation::max_augmented));
  require_moderate(root, "estimate", c.state.estimate);
  c.state.error = error_from_json(root, c.state.estimate.size());
  c.state.return_gate = return_gate_from_json(root);
  root.refuse_unknown();
  return c;
}

}  // namespace ehm::monitor
