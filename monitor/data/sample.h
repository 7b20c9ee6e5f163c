// SPDX-License-Identifier: Apache-2.0
#pragma once
// One sensor sample as the cycle sees it: the wire's EngineSensors without DDS.

#include <array>
#include <cstdint>

#include "engine_sim/linear_model/capacity.h"
#include "engine_sim/linear_model/linear_model.h"

namespace ehm::monitor {

struct Sample {
  std::uint32_t schema = 0;
  std::uint32_t source_id = 0;
  std::uint64_t writer = 0;  ///< tells writers with the same source_id apart; 0: not known
  std::uint64_t sequence = 0;
  std::int64_t source_time_ns = 0;
  linear_model::OperatingPoint flight;
  std::uint32_t sensor_valid = 0;  ///< bit i: the source vouches for sensor i
  std::uint32_t sensor_count = 0;
  std::uint32_t actuator_count = 0;
  std::array<double, linear_model::max_actuators> actuator{};
  std::array<double, linear_model::max_sensors> sensor{};
};

}  // namespace ehm::monitor
