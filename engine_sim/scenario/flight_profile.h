// SPDX-License-Identifier: Apache-2.0
#pragma once
// Flight condition, demand and off-take at a time: linear between the points of the profile, held outside.

#include <vector>

#include "engine_sim/scenario/scenario.h"

namespace ehm::engine_sim {

class FlightProfile {
 public:
  /// `start` holds where the profile is empty.
  FlightProfile(ProfilePoint start, std::vector<ProfilePoint> points);

  ProfilePoint at(double time_s) const;
  /// From now on these hold, whatever the profile says: an operator took over.
  void override_demand(const Demand& demand);
  void override_flight(const FlightCondition& flight);

 private:
  std::vector<ProfilePoint> points_;
  bool demand_overridden_ = false, flight_overridden_ = false;
  ProfilePoint override_;
};

}  // namespace ehm::engine_sim
