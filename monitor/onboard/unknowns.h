// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the on-board filter estimates, as one vector of n = 2 + p + c + m, scaled so that each is of the size of one:
//   speeds   2   N1, N2 in percent of the design point's
//   health   p   percent
//   causes   c   of mismatch, in their standard deviations
//   bias     m   path-driven, of each sensor, in percent of its reading
// Readings count in percent of what is predicted, auxiliary outputs in their units. Errors: none.

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/mismatch/mismatch.h"
#include "monitor/estimation/capacity.h"
#include "monitor/onboard/on_board_model.h"

namespace ehm::onboard {

inline constexpr int speed_count = 2, max_causes = static_cast<int>(engine_sim::mismatch_count);
inline constexpr int most_health = static_cast<int>(engine_sim::health_count);
inline constexpr int max_unknowns = speed_count + most_health + max_causes + estimation::max_sensors;

using UnknownVector = estimation::BoundedVector<max_unknowns>;
using UnknownMatrix = estimation::BoundedMatrix<max_unknowns, max_unknowns>;

struct UnknownLayout {
  explicit UnknownLayout(const OnBoardModel& model)
      : health_count(as_index(model.definition().channels.health.size())),
        cause_count(as_index(model.causes().size())),
        sensor_count(as_index(model.sensors().size())),
        auxiliary_count(as_index(model.auxiliary().size())) {}

  Eigen::Index health_count, cause_count, sensor_count, auxiliary_count;

  static constexpr Eigen::Index first_health() { return speed_count; }
  Eigen::Index first_cause() const { return first_health() + health_count; }
  Eigen::Index first_bias() const { return first_cause() + cause_count; }
  Eigen::Index count() const { return first_bias() + sensor_count; }
};

}  // namespace ehm::onboard
