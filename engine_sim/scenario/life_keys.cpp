// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/scenario/life_keys.h"

#include <string>

#include "engine_sim/scenario/life.h"

namespace ehm::engine_sim {

namespace {
constexpr std::int64_t longest_life = 6000;
}

void LifeKeys::declare(config::Schema& schema) {
  schema.integer("life.cycles", cycles_, -1, longest_life, "flights",
                 "that the engine has flown: its wear by the table of scenario/life.h; -1: none but [[wear]]");
  schema.integer("life.washed_at", washed_at_, 0, longest_life, "flights",
                 "after so many it was washed, which gives back half of what its compressors had lost; 0 is never");
  schema.integer("life.replaced_at", replaced_at_, 0, longest_life, "flights",
                 "after so many its turbines were replaced; 0 is never");
  schema.integer("life.seed", seed_, 0, 9007199254740992, "",
                 "which engine of a fleet, whose parameters wear each at a pace of its own; 0: as the table");
}

void LifeKeys::finish(Scenario& scenario) const {
  if (cycles_ < 0 && (washed_at_ != 0 || replaced_at_ != 0 || seed_ != 0))
    throw config::ConfigError(
        "'life.washed_at', 'life.replaced_at' and 'life.seed' go with 'life.cycles', which is not given");
  if (cycles_ < 0) return;
  for (const auto& [key, at] : {std::pair{"life.washed_at", washed_at_}, {"life.replaced_at", replaced_at_}})
    if (at > cycles_)
      throw config::ConfigError("'" + std::string(key) + "' is " + std::to_string(at) +
                                ", allowed is up to life.cycles, " + std::to_string(cycles_));
  Life life{static_cast<double>(cycles_), static_cast<double>(washed_at_), static_cast<double>(replaced_at_)};
  if (seed_ != 0) life.pace = drawn_pace(static_cast<std::uint64_t>(seed_));
  const HealthVector health = health_of(life);
  for (std::size_t j = 0; j < health.size(); ++j) scenario.wear[j].initial += health[j];
}

}  // namespace ehm::engine_sim
