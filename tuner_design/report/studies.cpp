#include "tuner_design/report/studies.h"

#include "tuner_design/choose_tuners.h"

namespace ehm::bench::report {
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

}  // namespace

Studies run_studies(const design::Design& design, const StudyOptions& options) {
  Studies studies;
  studies.courses = search_again(design, options.threads);
  constexpr double search_share = 0.1;
  options.progress(search_share);
  const std::vector<double> steps = logarithmic_steps(slowest_qh, fastest_qh, trade_points);
  studies.trade = response_sweep(design, steps, options.threads, [&](std::size_t done) {
    options.progress(search_share + (1.0 - search_share) * static_cast<double>(done) / trade_points);
  });
  return studies;
}

}  // namespace ehm::bench::report
