// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/engines/engine_definition.h"

#include <cctype>

namespace ehm::engine_sim {

std::string engine_type(const EngineData& data) {
  std::string type = data.name;
  for (char& c : type) c = c == ' ' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return type;
}

}  // namespace ehm::engine_sim
