// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/kosanam/constrained_tables.h"

namespace ehm::tuner_design {
namespace {

constexpr double behind_sigma = 2.0, far_behind_sigma = 3.0;

std::vector<FilterCase> cases_of(const BatchProblem& problem) {
  const SteadyFilter s = steady_filter(problem);
  return {{"Kalman, steady", s},
          {"Kalman, time-varying", std::nullopt},
          {"W = I", s, BatchWay::identity},
          {"W = P^-1", s, BatchWay::projection},
          {"W = I, fed back", s, BatchWay::identity, true},
          {"W = P^-1, fed back", s, BatchWay::projection, true},
          {"W = P^-1, 2 sigma behind", s, BatchWay::projection, false, behind_sigma},
          {"W = P^-1, 2 sigma behind, fed back", s, BatchWay::projection, true, behind_sigma},
          {"truncation", s, BatchWay::truncation},
          {"truncation, fed back", s, BatchWay::truncation, true},
          {"truncation, 2 sigma behind", s, BatchWay::truncation, false, behind_sigma},
          {"truncation, 3 sigma behind", s, BatchWay::truncation, false, far_behind_sigma}};
}

}  // namespace

ConstrainedTables constrained_tables(const linear_model::LinearModel& model, const ConstrainedTablesOptions& options,
                                     const std::function<void(double)>& progress) {
  ConstrainedTables tables;
  tables.options = options;
  tables.options.batch.cycles_a_flight = whole_life_cycles / options.batch.flights;
  const BatchProblem nominal = batch_problem(model, options.health_variance);
  tables.model = nominal.model;
  tables.sample_time_s = nominal.sample_time_s;
  tables.health = names_of(model.health);
  tables.not_known = wear_law(tables.health, tables.options.batch.cycles_a_flight).not_known;
  const double count = static_cast<double>(options.sweep.size());
  for (const double factor : options.sweep) {
    const BatchProblem problem = with_health_variance(nominal, factor * options.health_variance);
    const double done = static_cast<double>(tables.sweep.size());
    tables.sweep.push_back({factor, fly_batches(problem, cases_of(problem), tables.options.batch, [&](std::size_t run) {
                              progress((done + static_cast<double>(run) / options.batch.runs) / count);
                            })});
    const std::size_t latest = tables.sweep.size() - 1;
    if (tables.sweep[latest].result.mean_rms(constrained_case::kalman) <
        tables.table().mean_rms(constrained_case::kalman))
      tables.best = latest;
  }
  return tables;
}

}  // namespace ehm::tuner_design
