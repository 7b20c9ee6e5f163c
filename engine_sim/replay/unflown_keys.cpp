// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/replay/unflown_keys.h"

#include <algorithm>
#include <array>

namespace ehm::engine_sim {

std::string unflown_keys(const std::vector<std::string>& given) {
  constexpr std::array used{"dds.", "log.", "replay.", "run.rate", "run.lockstep_window", "run.wait_for_monitors"};
  std::string unflown;
  for (const std::string& key : given) {
    if (std::any_of(used.begin(), used.end(), [&](const char* prefix) { return key.starts_with(prefix); })) continue;
    unflown += (unflown.empty() ? "'" : ", '") + key + "'";
  }
  return unflown;
}

}  // namespace ehm::engine_sim
