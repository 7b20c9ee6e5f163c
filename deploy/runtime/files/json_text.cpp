// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/files/json_text.h"

#include <algorithm>

namespace ehm::files {
namespace {

using Json = nlohmann::json;

bool fits_on_one_line(const Json& json) {
  return !json.is_structured() ||
         std::none_of(json.begin(), json.end(), [](const Json& element) { return element.is_structured(); });
}

void append(std::string& text, const Json& json, std::size_t depth) {
  if (fits_on_one_line(json)) {
    text += json.dump();
    return;
  }
  const std::string indent(depth + 1, ' ');
  text += json.is_object() ? "{\n" : "[\n";
  bool first = true;
  for (const auto& [key, value] : json.items()) {
    if (!first) text += ",\n";
    first = false;
    text += indent;
    if (json.is_object()) text += Json(key).dump() + ": ";
    append(text, value, depth + 1);
  }
  text += "\n" + std::string(depth, ' ') + (json.is_object() ? "}" : "]");
}

}  // namespace

std::string readable_text(const Json& json) {
  std::string text;
  append(text, json, 0);
  return text + "\n";
}

}  // namespace ehm::files
