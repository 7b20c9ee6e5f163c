// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/engines/shipped_engines.h"

#include "deploy/runtime/files/file_error.h"
#include "engine_sim/engines/engine_file.h"
#include "engine_sim/engines/jt9d_engine.h"
#include "engine_sim/engines/shipped_texts.h"

namespace ehm::engine_sim {
namespace {

std::shared_ptr<const EngineDefinition> high_bypass() {
  static const auto engine =
      std::make_shared<const EngineDefinition>(engine_from_text(high_bypass_text, "high_bypass.json"));
  return engine;
}

struct Shipped {
  const char* name;
  std::shared_ptr<const EngineDefinition> (*engine)();
};
constexpr Shipped shipped[] = {{"jt9d", default_engine}, {"high_bypass", high_bypass}};

}  // namespace

const std::vector<std::string>& shipped_engine_list() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Shipped& one : shipped) list.emplace_back(one.name);
    return list;
  }();
  return names;
}

std::string shipped_engine_names() {
  std::string text;
  for (const std::string& name : shipped_engine_list()) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::shared_ptr<const EngineDefinition> named_engine(const std::string& name_or_file) {
  for (const Shipped& one : shipped)
    if (name_or_file == one.name) return one.engine();
  if (name_or_file.find_first_of("/.") == std::string::npos)
    throw files::FileError("no engine is named '" + name_or_file + "'; allowed: " + shipped_engine_names() +
                           ", or an engine file, such as ./" + name_or_file + ".json");
  return std::make_shared<const EngineDefinition>(read_engine(name_or_file));
}

}  // namespace ehm::engine_sim
