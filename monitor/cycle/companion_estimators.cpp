// SPDX-License-Identifier: Apache-2.0
#include "monitor/cycle/companion_estimators.h"

#include <algorithm>

namespace ehm::monitor {

void CompanionEstimators::save(std::vector<CompanionState>& states) const noexcept {
  states.resize(all_.size());
  for (std::size_t i = 0; i < all_.size(); ++i) {
    states[i].name = all_[i].tally.name;
    all_[i].estimator->save(states[i].state);
  }
}

bool CompanionEstimators::restore(const std::vector<CompanionState>& states, int unseen) noexcept {
  bool all = true;
  for (Flying& one : all_) {
    const auto own =
        std::find_if(states.begin(), states.end(), [&](const auto& s) { return s.name == one.tally.name; });
    one.went_on = own != states.end() && one.estimator->restore(own->state);
    if (one.went_on) one.unseen = unseen;
    all = all && one.went_on;
  }
  return all;
}

int CompanionEstimators::find(std::string_view name) const noexcept {
  const auto own = std::find_if(all_.begin(), all_.end(), [&](const Flying& one) { return one.tally.name == name; });
  return own == all_.end() ? -1 : static_cast<int>(own - all_.begin());
}

void CompanionEstimators::update(estimation::SensorMask fused, std::int64_t hold) noexcept {
  for (Flying& one : all_) {
    if (!one.flies) continue;
    {
      const Lap lap(now_ns_, one.lap_ns);
      one.estimator->update(fused, hold);
    }
    one.tally.count(one.estimator->estimate().holds, one.lap_ns);
    one.tally.look(one.estimator->innovation(), fused);
  }
}

}  // namespace ehm::monitor
