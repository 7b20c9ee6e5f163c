// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/design/design_tuner.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "deploy/runtime/long_work/parallel_for.h"
#include "deploy/runtime/numbers/index.h"
#include "monitor/design/detectability.h"
#include "monitor/estimation/linear/solver_error.h"
#include "tuner_design/design/choose_tuners.h"
#include "tuner_design/design/tuner_number.h"
#include "tuner_design/search/row_space.h"
#include "tuner_design/theory/bayes_limit.h"
#include "tuner_design/theory/kalman_error.h"
#include "tuner_design/theory/kalman_gain.h"
#include "tuner_design/theory/map_estimator.h"
#include "tuner_design/theory/observability.h"

namespace ehm::tuner_design {
namespace {

using design::Design;
using design::DesignOptions;
using design::ErrorByChannel;
using design::SubsetDesign;
using linear_model::LinearModel;

constexpr double search_share = 0.6;  ///< of the time, roughly: the search for all sensors; the rest is without each

Observability observability_of(const PreparedPoint& point, const std::vector<int>& sensors) {
  LinearModel part;
  part.health = point.model.health;
  part.health_sigma = point.model.health_sigma;
  part.sensor_noise_sigma = point.model.sensor_noise_sigma(sensors);
  for (const int sensor : sensors) part.sensors.push_back(point.model.sensors[as_size(sensor)]);
  return steady_observability(part, point.steady.H(sensors, Eigen::all));
}

/// The filter on V and its error.
SubsetDesign filter_on(const PreparedPoint& point, const std::vector<int>& sensors, const Eigen::MatrixXd& V,
                       double qh_percent2) {
  SubsetDesign design = kalman_gain(point.model, sensors, V, qh_percent2);
  add_error_theory(design, point.model, point.steady);
  return design;
}

bool within_prior(const SubsetDesign& design, const LinearModel& scaled_model) {
  return (design.health_total_covariance.diagonal().array() <= scaled_model.health_sigma.array().square()).all();
}

bool knows_its_error(const Envelope& envelope) {
  return std::any_of(envelope.points.begin(), envelope.points.end(),
                     [](const PreparedPoint& point) { return point.model.linearisation_error.size() > 0; });
}

/// J of the Kalman filters on the chosen tuners, by their error theory: of any number of sensors, while the search's own
/// objective has a capacity.
double objective_of(const SearchProblem& problem, const std::vector<SubsetDesign>& filters) {
  double sum = 0.0, weights = 0.0;
  for (std::size_t i = 0; i < filters.size(); ++i) {
    const SearchPoint& point = problem.points[i];
    sum += point.weight * (point.problem.health_weight * filters[i].health_total_covariance.trace() +
                           point.problem.auxiliary_weight.dot(filters[i].auxiliary_total_covariance.diagonal()));
    weights += point.weight;
  }
  return sum / weights;
}

/// Tuners with the filter of every point on them.
struct Candidate {
  ChosenTuners tuners;
  std::vector<SubsetDesign> filters;
  double objective = 0.0;
  bool within_prior = true;
};

Candidate candidate_with(
    const Envelope& envelope, const std::vector<int>& sensors, Eigen::Index t, const DesignOptions& options,
    int random_starts, unsigned threads, const DesignProgress& progress = [](double) {}) {
  Candidate candidate;
  candidate.tuners = choose_tuners(envelope, sensors, t, options, random_starts, threads, progress);
  for (const PreparedPoint& point : envelope.points) {
    candidate.filters.push_back(filter_on(point, sensors, candidate.tuners.search.V, options.qh_percent2));
    candidate.within_prior = candidate.within_prior && within_prior(candidate.filters.back(), point.model);
  }
  candidate.objective = options.tuning == design::Tuning::closed_form
                            ? objective_of(candidate.tuners.problem, candidate.filters)
                            : objective(candidate.tuners.problem, candidate.tuners.search.V);
  return candidate;
}

/// For a point of an envelope that sees least.
Eigen::Index most_tuners_of(const Envelope& envelope, const std::vector<int>& sensors, double qh_percent2) {
  Eigen::Index most = envelope.points.front().model.L.cols();
  for (const PreparedPoint& point : envelope.points) most = std::min(most, most_tuners(point, sensors, qh_percent2));
  return most;
}

/// Least objective of all numbers of tuners, of those within the prior if there are any. A model that knows its
/// linearisation error may leave no sensible choice within the prior: one that costs more than a quarter of the
/// objective is not taken. none: no number of tuners has a filter.
std::optional<Candidate> best_number_of_tuners(const Envelope& envelope, const std::vector<int>& sensors,
                                               const DesignOptions& options) {
  constexpr double too_dear = 1.25;
  const Eigen::Index most = most_tuners_of(envelope, sensors, options.qh_percent2);
  std::optional<Candidate> best, best_within;
  for (Eigen::Index t = most; t >= 1; --t) {
    try {
      const Candidate candidate = candidate_with(envelope, sensors, t, options, 0, 1);
      if (!best || candidate.objective < best->objective) best = candidate;
      if (candidate.within_prior && (!best_within || candidate.objective < best_within->objective))
        best_within = candidate;
    } catch (const estimation::SolverError&) {
      // no filter on so many tuners: fewer may have one
    }
  }
  const bool affordable =
      best_within && (!knows_its_error(envelope) || best_within->objective <= too_dear * best->objective);
  return affordable ? best_within : best;
}

std::optional<SubsetDesign> design_without(int absent, const PreparedPoint& point, const DesignOptions& options) {
  std::vector<int> present = all_sensors(point.model);
  std::erase(present, absent);
  present = seeing_sensors({point}, present);
  if (present.empty()) return std::nullopt;
  std::optional<Candidate> best = best_number_of_tuners({{point}, {1.0}}, present, options);
  // A model that misses so much of its engine may have none within the prior; the least bad one still tells its sigma.
  if (!best || (!best->within_prior && point.model.linearisation_error.size() == 0)) return std::nullopt;
  return std::move(best->filters.front());
}

/// Sensors that see something, on as many tuners as they can teach; fewer where sigma would exceed the fleet's own, or
/// where a model's linearisation error asks for it.
Candidate design_full(
    const Envelope& envelope, const std::vector<int>& sensors, const DesignOptions& options, int random_starts,
    unsigned threads, const DesignProgress& progress = [](double) {}) {
  const Eigen::Index most = most_tuners_of(envelope, sensors, options.qh_percent2);
  if (knows_its_error(envelope)) {
    const std::optional<Candidate> best = best_number_of_tuners(envelope, sensors, options);
    const Eigen::Index tuners = best ? best->tuners.search.V.rows() : most;
    return candidate_with(envelope, sensors, tuners, options, random_starts, threads, progress);
  }
  Candidate first = candidate_with(envelope, sensors, most, options, random_starts, threads, progress);
  if (first.within_prior || envelope.points.size() > 1) return first;
  for (Eigen::Index t = most - 1; t >= 1; --t) {
    Candidate fewer = candidate_with(envelope, sensors, t, options, random_starts, threads);
    if (fewer.within_prior) return fewer;
  }
  return first;
}

/// Variances of health and of the auxiliary outputs for an error covariance of health.
ErrorByChannel by_channel(const Eigen::MatrixXd& health_covariance, const Eigen::MatrixXd& Hz) {
  return {health_covariance.diagonal(), (Hz * health_covariance * Hz.transpose()).diagonal()};
}

void add_errors_and_limits(Design& design, const PreparedPoint& point) {
  const Eigen::MatrixXd &H = point.steady.H, &Hz = point.steady.Hz;
  const Eigen::MatrixXd Ph = point.model.health_sigma.cwiseAbs2().asDiagonal();
  const Eigen::MatrixXd R = point.model.sensor_noise_sigma.cwiseAbs2().asDiagonal();
  const Eigen::MatrixXd full = full_map_gain(H, Ph, R);
  design::FleetUnknowns unknowns = design::fleet_unknowns(point.model, point.steady);
  unknowns.sensors = unknowns.sensors(design.full.sensors, Eigen::all).eval();
  const Eigen::MatrixXd reduced = reduced_map_gain(H, Ph, R, design.full.V);
  design.linearisation = {design.full.health_linearisation_covariance.diagonal(),
                          design.full.auxiliary_linearisation_covariance.diagonal()};
  design.ssee = {design.full.health_total_covariance.diagonal() - design.linearisation.health,
                 design.full.auxiliary_total_covariance.diagonal() - design.linearisation.auxiliary};
  design.bayes_limit = steady_limit(unknowns);
  design.full_map = by_channel(snapshot_error_covariance(full, H, Ph, R), Hz);
  design.reduced_map = by_channel(snapshot_error_covariance(reduced, H, Ph, R), Hz);
}

design::Certificate certificate_of(const ChosenTuners& tuners, const SubsetDesign& filter, const PreparedPoint& point) {
  design::Certificate certificate;
  certificate.starts = tuners.search.starts;
  certify(certificate, tuners.problem, tuners.search.V);
  certificate.closed_form_objective = tuners.closed_form.value_or(certificate.objective);
  const Observability observability = observability_of(point, filter.sensors);
  certificate.steady_singular_values = observability.singular_values;
  certificate.condition = observability.condition;
  certificate.pair_singular_values = pair_singular_values(filter.A, filter.C, point.model.sensor_noise_sigma);
  return certificate;
}

/// All of a design but those for a missing sensor.
Design full_design(const LinearModel& model, const PreparedPoint& point, const DesignOptions& options,
                   const ChosenTuners& tuners, SubsetDesign filter) {
  Design design;
  design.model = model;
  design.options = options;
  design.scaling = point.scaling;
  design.certificate = certificate_of(tuners, filter, point);
  design.certificate.slow_bias_detectability = design::slow_bias_detectability(model, point.scaling, filter);
  design.full = std::move(filter);
  add_errors_and_limits(design, point);
  return design;
}

void require_same_channels(const std::vector<LinearModel>& models) {
  const auto names = [](const std::vector<linear_model::Channel>& channels) {
    std::string text;
    for (const linear_model::Channel& channel : channels) text += channel.name + " in " + channel.unit + ", ";
    return text;
  };
  const LinearModel& first = models.front();
  for (const LinearModel& model : models) {
    const auto require = [&](const char* what, const auto& own, const auto& others) {
      if (names(own) == names(others)) return;
      throw std::invalid_argument(std::string("envelope: model ") + model.name + " has other " + what + " than " +
                                  first.name + "; allowed are models of one engine with the same channels and units");
    };
    require("health parameters", model.health, first.health);
    require("sensors", model.sensors, first.sensors);
    require("auxiliary outputs", model.auxiliary, first.auxiliary);
  }
}

}  // namespace

std::vector<std::string> worse_than_prior(const SubsetDesign& design, const LinearModel& model,
                                          const linear_model::Scaling& scaling) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < model.health.size(); ++i) {
    const auto at = as_index(i);
    const double prior = model.health_sigma(at) / scaling.health(at);
    if (design.health_total_covariance(at, at) > prior * prior) names.push_back(model.health[i].name);
  }
  return names;
}

Eigen::MatrixXd full_set_tuners(const Envelope& envelope, const DesignOptions& options) {
  const std::vector<int> all = all_sensors(envelope.points.front().model);
  require_observable(observability_of(envelope.points.front(), all));
  const std::vector<int> seeing = seeing_sensors(envelope.points, all);
  return design_full(envelope, seeing, options, 0, 1).tuners.search.V;
}

std::optional<SubsetDesign> closed_form_filter(const PreparedPoint& point, const std::vector<int>& sensors,
                                               double qh_percent2, const design::ErrorWeights& weights) {
  const std::vector<int> seeing = seeing_sensors({point}, sensors);
  if (seeing.empty()) return std::nullopt;
  DesignOptions options;
  options.qh_percent2 = qh_percent2;
  options.weights = weights;
  options.tuning = design::Tuning::closed_form;
  try {
    Candidate full = design_full({{point}, {1.0}}, seeing, options, 0, 1);
    if (!full.within_prior) return std::nullopt;
    return std::move(full.filters.front());
  } catch (const estimation::SolverError&) {  // the sensors tell so many tuners apart too badly
    return std::nullopt;
  }
}

Design design_on_tuners(const LinearModel& model, const Eigen::MatrixXd& V, double qh_percent2) {
  const PreparedPoint point = prepare(model);
  DesignOptions options;
  options.qh_percent2 = qh_percent2;
  options.tuning = design::Tuning::closed_form;
  ChosenTuners tuners = choose_tuners({{point}, {1.0}}, all_sensors(model), V.rows(), options, 0, 1);
  tuners.closed_form = objective(tuners.problem, tuners.search.V);
  tuners.search.V = row_space(V);
  Design design =
      full_design(model, point, options, tuners, filter_on(point, all_sensors(model), tuners.search.V, qh_percent2));
  design.missing.resize(model.sensors.size());
  return design;
}

std::vector<Design> design_envelope(const std::vector<LinearModel>& models, const std::vector<double>& weights,
                                    const DesignOptions& options, unsigned threads, const DesignProgress& progress) {
  if (!(options.qh_percent2 > 0.0) || !std::isfinite(options.qh_percent2)) {
    throw std::invalid_argument("qh is " + std::to_string(options.qh_percent2) +
                                "; allowed: above 0 percent^2 per sample (without it the filter stops listening)");
  }
  if (models.empty() || weights.size() != models.size())
    throw std::invalid_argument("envelope: one weight is needed for each of one or more models");
  require_same_channels(models);
  Envelope envelope{{}, weights};
  const std::vector<int> all = all_sensors(models.front());
  for (const LinearModel& model : models) {
    envelope.points.push_back(prepare(model));
    require_observable(observability_of(envelope.points.back(), all));
  }

  const std::vector<int> seeing = seeing_sensors(envelope.points, all);
  const Candidate full = design_full(envelope, seeing, options, options.random_starts, threads,
                                     [&](double share) { progress(search_share * share); });
  const double tasks = static_cast<double>(models.size() * all.size());
  std::vector<Design> designs;
  for (std::size_t i = 0; i < models.size(); ++i) {
    const PreparedPoint& point = envelope.points[i];
    Design design = full_design(models[i], point, options, full.tuners, full.filters[i]);
    design.missing.resize(all.size());
    long_work::parallel_for(
        all.size(), threads,
        [&](std::size_t absent) {
          // Without a sensor that no design uses nothing is missing.
          const bool blind = !std::binary_search(seeing.begin(), seeing.end(), all[absent]);
          design.missing[absent] = blind ? design.full : design_without(all[absent], point, options);
        },
        [&](std::size_t done) {
          const double share = static_cast<double>(i * all.size() + done) / tasks;
          progress(search_share + (1.0 - search_share) * share);
        });
    designs.push_back(std::move(design));
  }
  return designs;
}

Design design_tuner(const LinearModel& model, const DesignOptions& options, unsigned threads,
                    const DesignProgress& progress) {
  return std::move(design_envelope({model}, {1.0}, options, threads, progress).front());
}

}  // namespace ehm::tuner_design
