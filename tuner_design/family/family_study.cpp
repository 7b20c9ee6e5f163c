// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/family/family_study.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "deploy/runtime/long_work/parallel_for.h"
#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/discretise.h"
#include "engine_sim/linear_model/scaling.h"
#include "monitor/design/make_estimator.h"
#include "tuner_design/family/family_flight.h"
#include "tuner_design/flight/flight_engine.h"
#include "tuner_design/full_order/limit_after.h"
#include "tuner_design/linearise/engine_match.h"

namespace ehm::tuner_design {
namespace {

constexpr double flight_step_s = 0.1;
constexpr int limit_samples = 2667;  ///< 40 s of 15 ms
constexpr std::size_t engines_a_flight = 5;

double fan_speed_trim(const linear_model::LinearModel& model) {
  for (const auto& state : model.states)
    if (state.name == "Nf" && state.unit == "rpm") return state.trim;
  throw std::invalid_argument("study family: the design has no state Nf (rpm) whose trim the control could hold");
}

/// Of samples of that length, whose noise is as much less as a second brings equal information.
design::Design coarser(design::Design design, double step_s) {
  design.model.sensor_noise_sigma *= std::sqrt(design.model.sample_time_s / step_s);
  design.model.sample_time_s = step_s;
  return design;
}

struct Fliers {
  std::vector<std::string> names, left_out;
  std::vector<std::shared_ptr<const estimation::Estimator>> at_point, in_flight;
};

bool of_particles(const std::string& name) {
  return name == "particle" || name == "ekpf" || name == "cekpf";
}

/// Every estimator of the table that the design has the means for. Sensors at the point have no lags: nor have they for
/// who knows of lags.
Fliers fliers_of(const design::Design& design, const FamilyOptions& options) {
  Fliers fliers;
  monitor::EstimatorOptions at_point = options.estimator, in_flight = options.estimator;
  at_point.lag_speed_s = at_point.lag_pressure_s = at_point.lag_temperature_s = 0.0;
  const design::Design coarse = coarser(design, flight_step_s);
  for (const design::EstimatorKind& kind : design::estimator_kinds()) {
    if (!options.estimators.empty() && std::ranges::count(options.estimators, kind.name) == 0) continue;
    try {
      std::shared_ptr<const estimation::Estimator> here = design::make_estimator(kind.name, design, at_point, {}),
                                                   aloft;
      if (kind.basis == design::EstimatorBasis::engine && !of_particles(kind.name))
        aloft = design::make_estimator(kind.name, coarse, in_flight, {});
      fliers.names.emplace_back(kind.name);
      fliers.at_point.push_back(here);
      fliers.in_flight.push_back(aloft);
    } catch (const std::invalid_argument&) {
      fliers.left_out.emplace_back(kind.name);
    }
  }
  return fliers;
}

std::optional<FamilyScore> score_of(const std::vector<std::vector<FamilyOutcome>>& fleet, std::size_t estimator) {
  FamilyOutcome sum;
  sum.errors = sum.covered_of = Eigen::ArrayXd::Zero(fleet.front()[estimator].errors.size());
  std::vector<double> answers;
  double least_step_s = std::numeric_limits<double>::infinity();
  for (const auto& engine : fleet) {
    const FamilyOutcome& o = engine[estimator];
    sum.samples += o.samples;
    sum.held += o.held;
    sum.squares += o.squares;
    sum.claims += o.claims;
    sum.judged += o.judged;
    sum.covered += o.covered;
    sum.errors += o.errors;
    sum.covered_of += o.covered_of;
    if (o.answer_s) answers.push_back(*o.answer_s);
    least_step_s = std::min(least_step_s, o.step_s);
  }
  if (sum.held == 0.0) return std::nullopt;
  FamilyScore score{.held = sum.held / sum.samples,
                    .ssee = sum.squares / sum.held,
                    .claims = sum.claims / sum.held,
                    .coverage = sum.covered / sum.judged,
                    .bias = std::sqrt((sum.errors / sum.held).square().mean()),
                    .least_coverage = sum.covered_of.minCoeff() / sum.held,
                    .answer_s = {},
                    .step_us = 1e6 * least_step_s};
  if (2 * answers.size() > fleet.size()) {  // the others count as never
    std::sort(answers.begin(), answers.end());
    score.answer_s = answers[std::min(answers.size() - 1, fleet.size() / 2)];
  }
  return score;
}

FamilyCaseResult run_case(const FamilyFleet& fleet, std::size_t engines, const FamilyOptions& options,
                          const std::function<void(std::size_t)>& progress) {
  std::vector<std::optional<std::vector<FamilyOutcome>>> flown(engines);
  long_work::parallel_for(
      engines, options.threads, [&](std::size_t i) { flown[i] = fly_family(fleet, options.seed, i); }, progress);
  FamilyCaseResult result{.what = fleet.what, .scores = {}};
  std::vector<std::vector<FamilyOutcome>> all;
  for (auto& outcome : flown)
    if (outcome) all.push_back(std::move(*outcome));
  result.flown = all.size();
  result.failed = engines - all.size();
  for (std::size_t e = 0; e < fleet.fliers.size(); ++e)
    result.scores.push_back(all.empty() || !fleet.fliers[e] ? std::nullopt : score_of(all, e));
  return result;
}

}  // namespace

FamilyStudy run_family_study(const design::Design& design, const FamilyOptions& options,
                             const std::function<void(double)>& progress) {
  require_engine(design.model, *options.engine, "study family");
  const Fliers fliers = fliers_of(design, options);
  FamilyStudy study{.options = options,
                    .design_name = design.model.name,
                    .estimators = fliers.names,
                    .left_out = fliers.left_out,
                    .cases = {}};
  study.limit = limit_after(linear_model::scaled(linear_model::discretise(design.model), design.scaling), limit_samples)
                    .health.sum();
  FamilyFleet fleet{.what = FamilyCase::constant,
                    .engine = *options.engine,
                    .point = *design.model.operating_point,
                    .fan_speed_rpm = fan_speed_trim(design.model),
                    .step_s = design.model.sample_time_s,
                    .health_sigma = design.model.health_sigma,
                    .fliers = fliers.at_point};
  const std::size_t cases = options.cases.size();
  for (std::size_t c = 0; c < cases; ++c) {
    std::size_t engines = options.engines;
    fleet.what = options.cases[c];
    if (fleet.what == FamilyCase::flight) {
      fleet.engine = *flown_engine(*options.engine, flight_step_s);
      fleet.step_s = flight_step_s;
      fleet.fliers = fliers.in_flight;
      engines = std::max<std::size_t>(2, engines / engines_a_flight);
    }
    study.cases.push_back(run_case(fleet, engines, options, [&](std::size_t done) {
      progress((static_cast<double>(c) + static_cast<double>(done) / static_cast<double>(engines)) /
               static_cast<double>(cases));
    }));
  }
  return study;
}

}  // namespace ehm::tuner_design
