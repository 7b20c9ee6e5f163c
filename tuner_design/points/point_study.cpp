// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/points/point_study.h"

#include <algorithm>
#include <utility>

#include "engine_sim/model/parts/root_theta.h"
#include "tuner_design/design/choose_tuners.h"
#include "tuner_design/design/design_tuner.h"
#include "tuner_design/design/shared_tuners.h"
#include "tuner_design/linearise/linearise.h"
#include "tuner_design/monte_carlo/evaluation.h"

namespace ehm::tuner_design {
namespace {

constexpr std::uint64_t fleet_seed = 1;  ///< of the engines that are linearised over
constexpr double settled_share = 7.0;    ///< slowest time constants before the window

double n1_at(const engine_sim::EngineData& engine, const StudiedPoint& point) {
  const double design_corrected = engine.design.speeds.n1_rpm / root_theta(engine.inlet, engine.design.flight);
  return point.share * design_corrected * root_theta(engine.inlet, point.flight);
}

linear_model::LinearModel model_at(const PointStudyOptions& options, const StudiedPoint& point) {
  LineariseOptions at;
  at.flight = point.flight;
  at.demand = {engine_sim::DemandKind::n1_rpm, n1_at(options.engine->data, point)};
  at.method = LineariseMethod::fleet;
  at.fleet = options.fleet;
  at.seed = fleet_seed;
  linear_model::LinearModel model = linearise(options.engine, at).model;
  model.name = point.name;
  return model;
}

PointError flown(const design::Design& design, const PointStudyOptions& options) {
  EvaluateOptions flight;
  flight.linear = flight.map = false;
  flight.nonlinear = true;
  flight.engine = options.engine;
  flight.runs = options.engines;
  flight.seconds = flight.window + settled_share * design.full.slowest_time_constant_s;
  flight.seed = options.seed;
  flight.threads = options.threads;
  const Experiment experiment = std::move(evaluate(design, flight).experiments.front());
  return {experiment.experiment.health.sum(), experiment.standard_error_of_total.health, experiment.theory_health(),
          experiment.coverage.health.minCoeff()};
}

PointResult studied(const PointStudyOptions& options, const StudiedPoint& point,
                    const linear_model::LinearModel& model) {
  PointResult result;
  result.name = point.name;
  result.n1_rpm = n1_at(options.engine->data, point);
  design::DesignOptions choice;
  choice.random_starts = 0;
  const design::Design with = design_tuner(model, choice, options.threads);
  result.limit = with.bayes_limit.health.sum();
  result.with = flown(with, options);
  linear_model::LinearModel trusted = model;
  trusted.linearisation_error.resize(0, 0);
  result.without = flown(design_tuner(trusted, choice, options.threads), options);
  return result;
}

/// Mean and worst SSEE(h) on V over what each point's own sensors allow.
SharedTuners cost_of(std::string name, const Eigen::MatrixXd& V, const std::vector<PointReadings>& points,
                     const Eigen::VectorXd& health_sigma) {
  SharedTuners cost{std::move(name), V.rows()};
  const Eigen::MatrixXd all = Eigen::MatrixXd::Identity(health_sigma.size(), health_sigma.size());
  for (const PointReadings& point : points) {
    const double ratio = steady_error_on(V, point, health_sigma) / steady_error_on(all, point, health_sigma);
    cost.mean += ratio / static_cast<double>(points.size());
    cost.worst = std::max(cost.worst, ratio);
  }
  return cost;
}

std::vector<SharedTuners> shared_over(const std::vector<linear_model::LinearModel>& models) {
  std::vector<PointReadings> points;
  Eigen::VectorXd health_sigma;
  for (const linear_model::LinearModel& model : models) {
    const PreparedPoint point = prepare(model);
    points.push_back({point.steady.H, lasting_noise(point.model, all_sensors(model))});
    health_sigma = point.model.health_sigma;
  }
  const Eigen::Index m = points.front().H.rows(), p = health_sigma.size();
  std::vector<SharedTuners> shared{cost_of("V* of " + models[cruise_point].name,
                                           shared_tuners({points[cruise_point]}, health_sigma, std::min(m, p)), points,
                                           health_sigma)};
  for (Eigen::Index t = std::min(m, p); t <= std::min(m + 2, p); ++t)
    shared.push_back(cost_of("one V* for all", shared_tuners(points, health_sigma, t), points, health_sigma));
  return shared;
}

}  // namespace

const std::vector<StudiedPoint>& studied_points() {
  static const std::vector<StudiedPoint> points{
      {"approach", {1000.0, 0.27, 0.0}, 0.70},     {"final approach", {300.0, 0.22, 0.0}, 0.78},
      {"holding", {4600.0, 0.45, 0.0}, 0.80},      {"slow cruise", {9449.0, 0.74, 0.0}, 0.88},
      {"low climb", {1100.0, 0.38, 0.0}, 0.98},    {"climb", {4600.0, 0.60, 0.0}, 1.00},
      {"top of climb", {9300.0, 0.79, 0.0}, 1.02}, {"cruise", {10668.0, 0.80, 0.0}, 0.98},
      {"take-off", {0.0, 0.25, 0.0}, 1.02}};
  return points;
}

PointStudy run_point_study(const PointStudyOptions& options, const std::function<void(double)>& progress) {
  PointStudy study;
  study.options = options;
  const std::vector<StudiedPoint>& points = studied_points();
  std::vector<linear_model::LinearModel> models;
  for (std::size_t i = 0; i < points.size(); ++i) {
    progress(static_cast<double>(i) / static_cast<double>(points.size()));
    models.push_back(model_at(options, points[i]));
    study.points.push_back(studied(options, points[i], models.back()));
  }
  study.shared = shared_over(models);
  progress(1.0);
  return study;
}

}  // namespace ehm::tuner_design
