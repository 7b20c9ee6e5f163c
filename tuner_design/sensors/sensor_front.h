// SPDX-License-Identifier: Apache-2.0
#pragma once
// Which sensors are worth having: the Pareto front of cost against J (sensor_set.h), exactly. Sets of sensors are taken
// in the order of their cost, at equal cost in the order of their bound (subset_bounds.h); a set whose bound is no
// better than the best J among the cheaper ones cannot be on the front, and its filter is not computed. So the number
// of filters is a part of 2^n. Bounds are zero where the sensors see all health parameters: beyond p sensors only the
// budget or the number of sensors saves work. The result and all counts are the same on any number of threads.

#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "tuner_design/sensors/sensor_set.h"

namespace ehm::tuner_design {

struct SensorChoice {
  std::vector<double> cost;  ///< of each candidate, not negative
  CandidateSet keep = 0;     ///< these are in every set
  double budget = std::numeric_limits<double>::infinity();
  int max_sensors = max_candidates;
};

struct FrontPoint {
  CandidateSet sensors = 0;
  double cost = 0.0;
  SensorSetValue value;
};

struct SensorFront {
  std::vector<FrontPoint> points;  ///< rising cost, J falling by more than 1e-9 of itself; of equal ones the first
  std::size_t sets = 0;            ///< within budget and number, with all that is to be kept
  std::size_t filters = 0;         ///< of these, designed and judged
};

/// Sum over the set, in the order of the candidates.
double cost_of(CandidateSet set, const std::vector<double>& cost);

/// `progress` gets done and total sets, by the calling thread.
SensorFront sensor_front(
    const SensorProblem& problem, const SensorChoice& choice, unsigned threads,
    const std::function<void(std::size_t, std::size_t)>& progress = [](std::size_t, std::size_t) {});

/// [i]: all candidates but i; nullopt where these are worth nothing.
std::vector<std::optional<SensorSetValue>> without_each(const SensorProblem& problem);

}  // namespace ehm::tuner_design
