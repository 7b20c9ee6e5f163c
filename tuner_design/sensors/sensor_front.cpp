// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/sensors/sensor_front.h"

#include <algorithm>
#include <bit>
#include <tuple>

#include "deploy/runtime/long_work/parallel_for.h"
#include "tuner_design/sensors/subset_bounds.h"

namespace ehm::tuner_design {
namespace {

/// What a dearer set must reach: better by more than the solvers' rounding, or a useless sensor would be bought for it.
double to_beat(double best) {
  constexpr double rounding = 1e-9;
  return best * (1.0 - rounding);  // infinity stays what it is
}

struct Candidate {
  double cost, bound;
  CandidateSet set;
};

/// Every set that is allowed, in the order in which they are judged.
std::vector<Candidate> allowed_sets(const SensorProblem& problem, const SensorChoice& choice) {
  const std::vector<double> bounds = subset_bounds(problem);
  std::vector<Candidate> sets;
  for (CandidateSet set = 1; set <= problem.every(); ++set) {
    if ((set & choice.keep) != choice.keep || std::popcount(set) > choice.max_sensors) continue;
    const double cost = cost_of(set, choice.cost);
    if (cost <= choice.budget) sets.push_back({cost, bounds[set], set});
  }
  std::sort(sets.begin(), sets.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.cost, a.bound, a.set) < std::tie(b.cost, b.bound, b.set);
  });
  return sets;
}

/// The next sets from `at` on that may improve on `best`; leaves `at` behind them.
std::vector<Candidate> next_batch(const std::vector<Candidate>& sets, std::size_t& at, double best) {
  constexpr std::size_t batch_size = 16;  // fixed: what is judged must not depend on the number of threads
  std::vector<Candidate> batch;
  for (; at < sets.size() && batch.size() < batch_size; ++at) {
    if (sets[at].bound < to_beat(best)) batch.push_back(sets[at]);
  }
  return batch;
}

}  // namespace

double cost_of(CandidateSet set, const std::vector<double>& cost) {
  double sum = 0.0;
  for (std::size_t i = 0; i < cost.size(); ++i) {
    if ((set >> i & 1U) != 0) sum += cost[i];
  }
  return sum;
}

SensorFront sensor_front(const SensorProblem& problem, const SensorChoice& choice, unsigned threads,
                         const std::function<void(std::size_t, std::size_t)>& progress) {
  const std::vector<Candidate> sets = allowed_sets(problem, choice);
  SensorFront front;
  front.sets = sets.size();
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t at = 0; at < sets.size();) {
    const std::vector<Candidate> batch = next_batch(sets, at, best);
    std::vector<std::optional<SensorSetValue>> values(batch.size());
    long_work::parallel_for(batch.size(), threads, [&](std::size_t i) { values[i] = value_of(problem, batch[i].set); });
    front.filters += batch.size();
    for (std::size_t i = 0; i < batch.size(); ++i) {
      if (!values[i] || !(values[i]->merit < to_beat(best))) continue;
      best = values[i]->merit;
      if (!front.points.empty() && front.points.back().cost == batch[i].cost) front.points.pop_back();
      front.points.push_back({batch[i].set, batch[i].cost, *values[i]});
    }
    progress(at, sets.size());
  }
  return front;
}

std::vector<std::optional<SensorSetValue>> without_each(const SensorProblem& problem) {
  std::vector<std::optional<SensorSetValue>> values;
  for (std::size_t i = 0; i < problem.model.sensors.size(); ++i) {
    values.push_back(value_of(problem, problem.every() & ~(CandidateSet{1} << i)));
  }
  return values;
}

}  // namespace ehm::tuner_design
