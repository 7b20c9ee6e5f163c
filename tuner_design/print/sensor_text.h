// SPDX-License-Identifier: Apache-2.0
#pragma once
// The result of a sensor selection as text, JSON and CSV: the same numbers. Squared errors are totals over the fleet,
// percent^2 for health and squared reporting units for the auxiliary outputs; J is the relative error of sensor_set.h.

#include <iosfwd>
#include <nlohmann/json.hpp>

#include "tuner_design/sensors/sensor_front.h"

namespace ehm::tuner_design {

struct SensorReport {
  SensorChoice choice;
  SensorFront front;
  std::optional<SensorSetValue> all;                   ///< every candidate together
  std::vector<std::optional<SensorSetValue>> without;  ///< [i] all but i
  double without_any = 0.0;                            ///< J of the fleet itself
};

nlohmann::ordered_json sensors_as_json(const SensorProblem& problem, const SensorReport& report);

void print_sensors(const SensorProblem& problem, const SensorReport& report, std::ostream& out);

/// One row a point of the front: cost,j,ssee_health,ssee_auxiliary,slowest_time_constant_s,tuners, then a column for
/// each candidate, 1 where the point has it.
std::string front_as_csv(const SensorProblem& problem, const SensorFront& front);

}  // namespace ehm::tuner_design
