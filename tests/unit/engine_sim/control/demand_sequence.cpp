// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/engine_sim/control/demand_sequence.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace ehm::test {
namespace {

/// Beyond both ends of what the control allows, so that every limit is asked for.
constexpr double lowest_rpm = 500.0, highest_rpm = 4500.0;

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : generator_(seed) {}
  double between(double a, double b) { return a + (b - a) * static_cast<double>(generator_() >> 11) * 0x1p-53; }
  bool chance(double probability) { return between(0.0, 1.0) < probability; }

 private:
  std::mt19937_64 generator_;
};

double highest_mach(double altitude_m) {
  return std::min(0.9, 0.45 + altitude_m / 22000.0);
}

void slam(std::vector<DemandPoint>& demand, double to_rpm, double hold_s) {
  const DemandPoint last = demand.back();
  demand.push_back({last.time_s, to_rpm});
  demand.push_back({last.time_s + hold_s, to_rpm});
}

void ramp(std::vector<DemandPoint>& demand, double to_rpm, double ramp_s, double hold_s) {
  const double start_s = demand.back().time_s;
  demand.push_back({start_s + ramp_s, to_rpm});
  demand.push_back({start_s + ramp_s + hold_s, to_rpm});
}

/// One manoeuvre after what there is.
void add_manoeuvre(std::vector<DemandPoint>& demand, Dice& dice) {
  const double kind = dice.between(0.0, 6.0);
  if (kind < 1.0) return slam(demand, dice.between(lowest_rpm, highest_rpm), dice.between(0.5, 6.0));
  if (kind < 2.0) return slam(demand, dice.chance(0.5) ? highest_rpm : lowest_rpm, dice.between(1.0, 8.0));
  if (kind < 3.0)
    return ramp(demand, dice.between(1500.0, highest_rpm), dice.between(0.3, 5.0), dice.between(0.0, 3.0));
  if (kind < 4.0) {  // body: from full power to idle, and back before the engine is there
    slam(demand, highest_rpm, dice.between(3.0, 7.0));
    slam(demand, lowest_rpm, dice.between(0.5, 5.0));
    return slam(demand, highest_rpm, dice.between(1.0, 4.0));
  }
  if (kind < 5.0) {  // the same from idle
    slam(demand, lowest_rpm, dice.between(3.0, 7.0));
    slam(demand, highest_rpm, dice.between(0.5, 4.0));
    return slam(demand, lowest_rpm, dice.between(1.0, 4.0));
  }
  for (int i = 0; i < 4; ++i) slam(demand, dice.between(lowest_rpm, highest_rpm), dice.between(0.1, 1.2));
}

}  // namespace

engine_sim::FlightCondition DemandSequence::flight_at(double time_s) const {
  const double altitude_m = std::clamp(flight.altitude_m + climb_m_s * time_s, 0.0, 13500.0);
  return {altitude_m, std::clamp(flight.mach + mach_per_s * time_s, 0.0, highest_mach(altitude_m)), flight.delta_isa_k};
}

double DemandSequence::n1_corrected_rpm(double time_s) const {
  const auto after = std::find_if(demand.begin(), demand.end(), [&](const auto& p) { return p.time_s > time_s; });
  if (after == demand.end()) return demand.back().n1_corrected_rpm;
  const DemandPoint &a = *(after - 1), &b = *after;
  return std::lerp(a.n1_corrected_rpm, b.n1_corrected_rpm, (time_s - a.time_s) / (b.time_s - a.time_s));
}

DemandSequence random_sequence(std::uint64_t seed, double duration_s) {
  Dice dice(seed);
  DemandSequence s;
  s.flight.altitude_m = dice.between(0.0, 13500.0);
  s.flight.mach = dice.between(0.0, highest_mach(s.flight.altitude_m));
  s.flight.delta_isa_k = dice.between(-20.0, 35.0);
  s.climb_m_s = dice.chance(0.5) ? 0.0 : dice.between(-20.0, 20.0);
  s.mach_per_s = dice.chance(0.5) ? 0.0 : dice.between(-0.004, 0.004);
  const bool worn = dice.chance(0.75);
  for (double& h : s.health) h = worn ? dice.between(-0.04, 0.01) : 0.0;
  s.demand = {{0.0, dice.between(lowest_rpm, highest_rpm)}};
  ramp(s.demand, s.demand.front().n1_corrected_rpm, 0.0, dice.between(0.5, 2.0));
  while (s.demand.back().time_s < duration_s) add_manoeuvre(s.demand, dice);
  return s;
}

}  // namespace ehm::test
