// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/engines/engine_file.h"

#include "deploy/runtime/files/atomic_file.h"
#include "deploy/runtime/files/content_hash.h"
#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/files/json_object.h"
#include "deploy/runtime/files/json_text.h"
#include "engine_sim/engines/channels_json.h"
#include "engine_sim/engines/control_json.h"
#include "engine_sim/engines/data_json.h"

namespace ehm::engine_sim {
namespace {

EngineDefinition engine_from(const files::Json& json, const std::string& file) {
  files::JsonObject root(json, file, "");
  const std::string schema = root.text("schema");
  if (schema != engine_schema)
    files::throw_defect(file, "schema", "\"" + schema + "\"", std::string("\"") + engine_schema + "\"",
                        "Convert the file to this format");
  EngineDefinition engine{root.find("source") != nullptr ? root.text("source") : "", engine_data_from(root),
                          control_from(root), channels_from(root)};
  root.refuse_unknown();
  return engine;
}

}  // namespace

EngineDefinition read_engine(const std::string& path) {
  return engine_from(files::parse_json_file(path), path);
}

EngineDefinition engine_from_text(const std::string& text, const std::string& file) {
  return engine_from(files::parse_json_text(text, file), file);
}

std::string engine_text(const EngineDefinition& engine) {
  files::Json json{
      {"schema", engine_schema}, {"control", to_json(engine.control)}, {"channels", to_json(engine.channels)}};
  if (!engine.source.empty()) json["source"] = engine.source;
  add_engine_data(json, engine.data);
  return files::readable_text(json);
}

void write_engine(const EngineDefinition& engine, const std::string& path) {
  files::write_file_atomically(path, engine_text(engine));
}

std::string engine_hash(const EngineDefinition& engine) {
  EngineDefinition numbers = engine;
  numbers.source.clear();
  return files::sha256_hex(engine_text(numbers));
}

}  // namespace ehm::engine_sim
