// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/wear/wear_law.h"

#include <algorithm>
#include <cmath>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/scenario/life.h"

namespace ehm::tuner_design {
namespace {

constexpr double half_life_cycles = 3000.0, early_cycles = 240.0;

/// Position in gas_path.h; -1: the name is not there.
Eigen::Index place_of(const std::string& name) {
  const auto at = std::find(engine_sim::health_names.begin(), engine_sim::health_names.end(), name);
  return at == engine_sim::health_names.end() ? -1 : at - engine_sim::health_names.begin();
}

}  // namespace

Eigen::VectorXd WearLaw::at(double flight) const {
  return -early * (1.0 - std::exp(-flight / early_flights)) - late * flight;
}

WearLaw wear_law(const std::vector<std::string>& health, double cycles_a_flight, double equal_percent) {
  const engine_sim::HealthVector half = engine_sim::health_of({.cycles = half_life_cycles}),
                                 whole = engine_sim::health_of({.cycles = 2.0 * half_life_cycles});
  WearLaw law;
  law.early_flights = early_cycles / cycles_a_flight;
  law.early.resize(as_index(health.size()));
  law.late = law.direction = law.early;
  for (std::size_t i = 0; i < health.size(); ++i) {
    const Eigen::Index place = place_of(health[i]);
    if (place < 0) law.not_known.push_back(health[i]);
    const auto from = as_size(std::max<Eigen::Index>(place, 0));  // fan_efficiency is the first
    const double scale = equal_percent > 0.0 ? equal_percent / std::abs(whole[from]) : 100.0;
    const double at_half = scale * half[from], at_whole = scale * whole[from];
    law.early(as_index(i)) = at_whole - 2.0 * at_half;
    law.late(as_index(i)) = (at_half - at_whole) / half_life_cycles * cycles_a_flight;
    law.direction(as_index(i)) = at_whole > 0.0 ? 1.0 : -1.0;
  }
  return law;
}

}  // namespace ehm::tuner_design
