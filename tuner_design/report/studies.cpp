// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/report/studies.h"

#include <algorithm>
#include <exception>

#include "tuner_design/design/choose_tuners.h"
#include "tuner_design/design/tuner_baselines.h"

namespace ehm::tuner_design::report {
namespace {

constexpr double fastest_qh = 1e-1, slowest_qh = 1e-6;
constexpr int trade_points = 21;

/// The other points of an envelope are not in the design file: their search cannot be repeated.
std::vector<SearchCourse> search_again(const design::Design& design, unsigned threads) {
  const design::Certificate& certificate = design.certificate;
  if (certificate.starts.empty() || certificate.points.size() != 1) return {};
  const ChosenTuners chosen = choose_tuners({{prepare(design.model)}, {1.0}}, design.full.sensors, design.full.V.rows(),
                                            design.options, design.options.random_starts, threads);
  std::vector<SearchCourse> courses;
  for (std::size_t i = 0; i < chosen.search.starts.size(); ++i)
    courses.push_back({chosen.search.starts[i].name, chosen.search.history[i]});
  return courses;
}

/// Shares of the time that the studies take.
constexpr double baseline_share = 0.1, search_share = 0.15, trade_share = 0.25, papers_share = 0.6;

std::vector<Baseline> compare(const design::Design& design, const StudyOptions& options) {
  constexpr double run_s = 30.0, most_samples = 1e6;
  const double sample_s = design.model.sample_time_s;
  const double total = std::max(1.0, static_cast<double>(subsets_to_try(design)));
  BaselineOptions baseline;
  baseline.run_s = std::clamp(run_s, sample_s, most_samples * sample_s);
  baseline.threads = options.threads;
  baseline.progress = [&](std::size_t done) { options.progress(baseline_share * static_cast<double>(done) / total); };
  return baselines(design, baseline);
}

void fly(Studies& studies, const design::Design& design, bool nonlinear, const StudyOptions& options, double from,
         double to) {
  EvaluateOptions flight;
  flight.linear = !nonlinear;
  flight.nonlinear = nonlinear;
  flight.engine = options.engine;
  flight.threads = options.threads;
  const std::string truth = nonlinear ? "the nonlinear engine" : "the linear engine";
  try {
    Evaluation evaluation =
        evaluate(design, flight, [&](double share) { options.progress(from + (to - from) * share); });
    for (Experiment& experiment : evaluation.experiments) studies.experiments.push_back(std::move(experiment));
  } catch (const std::exception& error) {  // a design for another engine, or one that cannot be flown
    studies.not_flown.push_back("No experiment on " + truth + ": " + error.what() + ".");
  }
}

void repeat_the_papers(Studies& studies, const design::Design& design, const StudyOptions& options, double from) {
  const auto fewer = design.model.sensors.size() < design.model.health.size();
  if (!fewer || design.model.auxiliary.empty() || published_subset(design.model).empty()) return;
  constexpr int first = 4, last = 7;
  for (int table = first; table <= last; ++table) {
    const double start = from + (1.0 - from) * (table - first) / 4.0, share_of_one = (1.0 - from) / 4.0;
    studies.papers.push_back(run_simon_garg(
        design.model, {.table = table, .qh_percent2 = design.options.qh_percent2, .threads = options.threads},
        [&](double share) { options.progress(start + share_of_one * share); }));
  }
}

}  // namespace

Studies run_studies(const design::Design& design, const StudyOptions& options) {
  Studies studies;
  studies.baselines = compare(design, options);
  options.progress(baseline_share);
  studies.courses = search_again(design, options.threads);
  options.progress(search_share);
  const double slow = options.quick ? 1.0 : trade_share;
  studies.trade = response_sweep(design, logarithmic_steps(slowest_qh, fastest_qh, trade_points), options.threads,
                                 [&](std::size_t done) {
                                   const double share = static_cast<double>(done) / trade_points;
                                   options.progress(search_share + (slow - search_share) * share);
                                 });
  if (options.quick) {
    studies.not_flown.push_back("The Monte Carlo was left out (--quick): theory stands unproven here.");
    return studies;
  }
  fly(studies, design, false, options, trade_share, 0.4);
  fly(studies, design, true, options, 0.4, papers_share);
  repeat_the_papers(studies, design, options, papers_share);
  return studies;
}

}  // namespace ehm::tuner_design::report
