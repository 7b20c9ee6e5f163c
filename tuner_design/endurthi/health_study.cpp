// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/endurthi/health_study.h"

#include <algorithm>
#include <utility>

#include "deploy/runtime/long_work/parallel_for.h"
#include "deploy/runtime/numbers/index.h"
#include "tuner_design/endurthi/linear_models.h"
#include "tuner_design/linearise/step_study.h"
#include "tuner_design/monte_carlo/random_stream.h"
#include "tuner_design/wear/wear_law.h"

namespace ehm::tuner_design::endurthi {
namespace {

constexpr std::size_t kinds = filter_kind_names.size();

}  // namespace

FlightTruth truth_of(const StudyPoint& point, double cycles) {
  const Eigen::VectorXd h_percent = wear_law(point.health_names(), 1.0).at(cycles);
  const StudyPoint worn = point.worn(0.01 * h_percent);
  return {h_percent, worn.sensor_trim(), worn.control_trim()};
}

HealthErrors errors_of(const Eigen::VectorXd& mean_squares, const Eigen::VectorXd& change) {
  const auto numbers_and_mean = [](const Eigen::VectorXd& v) {
    std::vector<double> numbers(v.begin(), v.end());
    numbers.push_back(v.mean());
    return numbers;
  };
  const Eigen::VectorXd percent = mean_squares.cwiseSqrt();
  return {numbers_and_mean(percent), numbers_and_mean(100.0 * percent.cwiseQuotient(change.cwiseAbs()))};
}

namespace {

std::vector<FlightTruth> truths_of(const StudyPoint& point, const HealthStudyOptions& options,
                                   const std::function<void(std::size_t)>& done) {
  std::vector<FlightTruth> truths(std::max(options.flights, options.life_flights));
  long_work::parallel_for(
      truths.size(), options.threads,
      [&](std::size_t k) { truths[k] = truth_of(point, options.cycles_per_flight * static_cast<double>(k + 1)); },
      done);
  return truths;
}

using Filters = std::vector<HealthFilter>;

Filters filters_on(const StudyPoint& point, const Eigen::MatrixXd& jacobian, const FilterSettings& settings) {
  Filters filters;
  for (std::size_t kind = 0; kind < kinds; ++kind)
    filters.emplace_back(point, jacobian, static_cast<FilterKind>(kind), settings);
  return filters;
}

/// One flight, 30 noisy samples, into all of them.
void fly(const StudyPoint& point, const FlightTruth& truth, RandomStream& random, Filters& filters) {
  Eigen::VectorXd y = truth.y;
  for (int k = 0; k < samples_a_flight; ++k) {
    for (Eigen::Index i = 0; i < y.size(); ++i) y(i) = truth.y(i) + point.noise_sigma(i) * random.normal();
    for (HealthFilter& filter : filters) filter.fuse(y, truth.u);
  }
  for (HealthFilter& filter : filters) filter.end_flight();
}

std::vector<double> numbers_of(const Eigen::VectorXd& v) {
  return {v.begin(), v.end()};
}

ModelHealth model_health(const StudyPoint& point, std::string name, const Eigen::MatrixXd& jacobian,
                         const std::vector<FlightTruth>& truths, const HealthStudyOptions& options) {
  std::array<Eigen::VectorXd, kinds> squares;
  squares.fill(Eigen::VectorXd::Zero(point.plant.health));
  const Filters cold = filters_on(point, jacobian, options.filter);
  for (std::size_t run = 0; run < options.runs; ++run) {
    RandomStream random(options.seed, run);
    Filters filters = cold;
    for (std::size_t flight = 0; flight < options.flights; ++flight) {
      fly(point, truths[flight], random, filters);
      for (std::size_t i = 0; i < kinds; ++i)
        squares[i] += (filters[i].health() - truths[flight].health_percent).cwiseAbs2();
    }
  }
  ModelHealth result{std::move(name), {}};
  for (std::size_t i = 0; i < kinds; ++i)
    result.by_kind[i] = errors_of(squares[i] / static_cast<double>(options.runs * options.flights),
                                  truths[options.flights - 1].health_percent);
  return result;
}

ColumnSteps steps_of(const HealthStudyOptions& options) {
  return {
      .relative = -0.01 * options.linearised_with_percent, .central = false, .response_s = ColumnSteps{}.response_s};
}

/// All 27 and the tangent. `done`: models that are done.
std::vector<ModelHealth> models_of(const StudyPoint& point, const std::vector<FlightTruth>& truths,
                                   const HealthStudyOptions& options, const std::function<void(std::size_t)>& done) {
  const ColumnSteps steps = steps_of(options);
  const auto models = jacobians(point.plant, steps);
  const Eigen::MatrixXd tangent = study_steps(point.plant).jacobian;
  std::vector<ModelHealth> results(model_count + 1);
  long_work::parallel_for(
      results.size(), options.threads,
      [&](std::size_t i) {
        const bool last = i == model_count;
        results[i] =
            model_health(point, last ? "tangent" : model_digits(i), last ? tangent : models[i], truths, options);
      },
      done);
  return results;
}

/// LIN120, life_model, without the 26 others.
Eigen::MatrixXd life_jacobian(const StudyPoint& point, const HealthStudyOptions& options) {
  const ColumnSteps steps = steps_of(options);
  const Eigen::MatrixXd states = state_columns(point.plant, ColumnMethod::linmod, steps);
  Eigen::MatrixXd jacobian(point.plant.outputs(), point.plant.inputs());
  jacobian << states, control_columns(point.plant, ColumnMethod::steady_state, steps, states),
      health_columns(point.plant, ColumnMethod::perturbation, steps, states);
  return jacobian;
}

/// One run over a life; each filter's model follows its own estimate.
std::vector<LifeFlight> life_of(const StudyPoint& point, const std::vector<FlightTruth>& truths,
                                const HealthStudyOptions& options) {
  RandomStream random(options.seed, options.runs);  // a run that the tables have not seen
  Filters filters = filters_on(point, life_jacobian(point, options), options.filter);
  std::vector<LifeFlight> life;
  for (std::size_t flight = 0; flight < options.life_flights; ++flight) {
    if (flight > 0 && flight % options.relinearised_each == 0) {
      for (HealthFilter& filter : filters) {
        const StudyPoint estimated = point.worn(filter.health() / 100.0);
        filter.relinearise(estimated, life_jacobian(estimated, options));
      }
    }
    fly(point, truths[flight], random, filters);
    LifeFlight& now = life.emplace_back();
    now.truth = numbers_of(truths[flight].health_percent);
    for (std::size_t i = 0; i < kinds; ++i) now.estimates[i] = numbers_of(filters[i].health());
  }
  return life;
}

}  // namespace

HealthStudy run_health_study(const HealthStudyOptions& options, const std::function<void(double)>& progress) {
  const std::vector<StudyPoint> points = study_points(*options.engine);
  HealthStudy study{options, {}};
  for (const StudyPoint& point : points) {
    // shares of the work, as measured
    const auto tell = [&](double from, double to, std::size_t done, std::size_t of) {
      const double share = from + (to - from) * static_cast<double>(done) / static_cast<double>(of);
      progress((static_cast<double>(study.points.size()) + share) / static_cast<double>(points.size()));
    };
    const std::vector<FlightTruth> truths = truths_of(point, options, [&](std::size_t done) {
      tell(0.0, 0.2, done, std::max(options.flights, options.life_flights));
    });
    HealthPoint result;
    result.name = point.name;
    result.n1_rpm = point.n1_rpm;
    result.health = point.health_names();
    result.change = truths[options.flights - 1].health_percent;
    result.models = models_of(point, truths, options, [&](std::size_t done) { tell(0.2, 0.9, done, model_count + 1); });
    result.life = life_of(point, truths, options);
    study.points.push_back(std::move(result));
  }
  progress(1.0);
  return study;
}

}  // namespace ehm::tuner_design::endurthi
