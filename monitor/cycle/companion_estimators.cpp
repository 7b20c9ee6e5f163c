// SPDX-License-Identifier: Apache-2.0
#include "monitor/cycle/companion_estimators.h"

#include <algorithm>

namespace ehm::monitor {

void CompanionEstimators::save(std::vector<CompanionState>& states) const noexcept {
  states.resize(all_.size());
  for (std::size_t i = 0; i < all_.size(); ++i) {
    states[i].name = all_[i].name;
    all_[i].estimator->save(states[i].state);
  }
}

bool CompanionEstimators::restore(const std::vector<CompanionState>& states, int unseen) noexcept {
  bool all = true;
  for (Flying& one : all_) {
    const auto own = std::find_if(states.begin(), states.end(), [&](const auto& s) { return s.name == one.name; });
    one.went_on = own != states.end() && one.estimator->restore(own->state);
    if (one.went_on) one.unseen = unseen;
    all = all && one.went_on;
  }
  return all;
}

}  // namespace ehm::monitor
