// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/scenario/flight_profile.h"

#include <algorithm>
#include <cmath>

namespace ehm::engine_sim {

FlightProfile::FlightProfile(ProfilePoint start, std::vector<ProfilePoint> points) : points_(std::move(points)) {
  if (points_.empty()) points_.push_back(start);
}

void FlightProfile::override_demand(const Demand& demand) {
  demand_overridden_ = true;
  override_.demand = demand;
}

void FlightProfile::override_flight(const FlightCondition& flight) {
  flight_overridden_ = true;
  override_.flight = flight;
}

ProfilePoint FlightProfile::at(double time_s) const {
  const auto after = std::upper_bound(points_.begin(), points_.end(), time_s,
                                      [](double t, const ProfilePoint& p) { return t < p.time_s; });
  ProfilePoint point;
  if (after == points_.begin()) {
    point = points_.front();
  } else if (after == points_.end()) {
    point = points_.back();
  } else {
    const ProfilePoint &a = *(after - 1), &b = *after;
    const double s = (time_s - a.time_s) / (b.time_s - a.time_s);
    point.flight = {std::lerp(a.flight.altitude_m, b.flight.altitude_m, s), std::lerp(a.flight.mach, b.flight.mach, s),
                    std::lerp(a.flight.delta_isa_k, b.flight.delta_isa_k, s)};
    point.demand = {a.demand.kind, std::lerp(a.demand.value, b.demand.value, s)};
    point.offtake = {std::lerp(a.offtake.customer_bleed_kg_s, b.offtake.customer_bleed_kg_s, s),
                     std::lerp(a.offtake.power_w, b.offtake.power_w, s)};
  }
  point.time_s = time_s;
  if (demand_overridden_) point.demand = override_.demand;
  if (flight_overridden_) point.flight = override_.flight;
  return point;
}

}  // namespace ehm::engine_sim
