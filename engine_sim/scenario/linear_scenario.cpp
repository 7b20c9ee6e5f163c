// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/scenario/linear_scenario.h"

#include <array>

#include "deploy/runtime/config/schema.h"

namespace ehm::engine_sim {

namespace {

struct Refused {
  const char *prefix, *why;
};
constexpr std::array refused{
    Refused{"flight.", "which holds at its own operating point only"},
    Refused{"demand.", "whose controls stay at their trims, but for [[control_change]]"},
    Refused{"control.", "whose controls stay at their trims, but for [[control_change]]"},
    Refused{"aircraft.", "which has no offtakes"},
    Refused{"mission.", "which holds at its own operating point only"},
    Refused{"mismatch.", "which is the truth itself"},
    Refused{"process_noise.speed_sigma_percent", "whose states move by the process_noise that it states"},
    Refused{"life.", "whose health is what [[wear]] says"},
    Refused{"sensors.", "whose sensors have the noise, resolution and update period that it states"},
    Refused{"engine.model", "which is an engine of its own"},
    Refused{"engine.heat_soak", "whose states are what it lists"},
    Refused{"run.sample_time_s", "which has a sample_time_s of its own"},
    Refused{"profile", "which holds at its own operating point only"},
    Refused{"replay.", "and a replay flies nothing"},
};

[[noreturn]] void refuse(const std::string& key, const char* why) {
  throw config::ConfigError("'" + key + "' is given, but 'linear.model' flies a linear model, " + why +
                            ": leave one of the two out");
}

}  // namespace

void check_linear(const std::vector<std::string>& given) {
  for (const std::string& key : given)
    for (const auto& [prefix, why] : refused)
      if (key.starts_with(prefix)) refuse(key, why);
}

}  // namespace ehm::engine_sim
