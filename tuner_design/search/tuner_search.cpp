// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/search/tuner_search.h"

#include <algorithm>
#include <exception>
#include <nlopt.hpp>
#include <random>
#include <stdexcept>

#include "deploy/runtime/long_work/parallel_for.h"
#include "deploy/runtime/numbers/index.h"
#include "deploy/runtime/numbers/noise_source.h"
#include "monitor/estimation/linear/solver_error.h"
#include "tuner_design/search/blind_tuner.h"
#include "tuner_design/search/kalman_objective.h"
#include "tuner_design/search/map_objective.h"
#include "tuner_design/search/row_space.h"

namespace ehm::tuner_design {
namespace {

constexpr double no_filter = 1e12;       ///< NLopt needs a finite number (theory.md, section 10)
constexpr int evaluations_a_chart = 40;  ///< then the chart is centred anew: far out it is badly scaled
constexpr int max_charts = 60;
constexpr double gradient_vanishes = 1e-8;  ///< of J
constexpr double same_end = 1e-12;          ///< relative
constexpr double improves = 1e-12;          ///< relative; less is rounding

/// What one run of NLopt sees and remembers. NLopt may end anywhere, also by an exception at an optimum: the best
/// point is kept here.
struct Run {
  const SearchProblem& problem;
  const RowSpaceChart& chart;
  std::vector<double>& history;
  double best;
  Eigen::VectorXd best_at;
  double gradient_norm;
  std::exception_ptr failure{};  ///< of the objective: NLopt would lose its type
};

double evaluate_at(const std::vector<double>& x, std::vector<double>& gradient, Run& run) {
  const Eigen::Map<const Eigen::VectorXd> at(x.data(), as_index(x.size()));
  Eigen::MatrixXd T, V_gradient;
  const Eigen::MatrixXd V = run.chart.at(at, &T);
  const double value = objective(run.problem, V, &V_gradient);
  if (!gradient.empty()) {
    Eigen::Map<Eigen::VectorXd>(gradient.data(), at.size()) = run.chart.gradient(V_gradient, T);
  }
  if (value < run.best) {
    run.best = value;
    run.best_at = at;
    run.gradient_norm = V_gradient.norm();
  }
  run.history.push_back(std::min(run.best, run.history.empty() ? value : run.history.back()));
  return value;
}

double evaluate(const std::vector<double>& x, std::vector<double>& gradient, void* data) {
  Run& run = *static_cast<Run*>(data);
  try {
    return evaluate_at(x, gradient, run);
  } catch (...) {
    run.failure = std::current_exception();
    throw nlopt::forced_stop();
  }
}

/// LBFGS in one chart, from its centre.
void minimise(Run& run) {
  constexpr double safety_s = 60.0;  // never reached; NLopt must not hang
  nlopt::opt optimiser(nlopt::LD_LBFGS, static_cast<unsigned>(run.chart.dimension()));
  optimiser.set_min_objective(evaluate, &run);
  optimiser.set_maxeval(evaluations_a_chart);
  optimiser.set_maxtime(safety_s);
  optimiser.set_ftol_rel(1e-15);
  std::vector<double> x(as_size(run.chart.dimension()), 0.0);
  double value = 0.0;
  try {
    optimiser.optimize(x, value);
  } catch (const nlopt::forced_stop&) {
    // the objective's own failure, below
  } catch (const nlopt::roundoff_limited&) {
    // at an optimum: the best point counts
  } catch (const std::runtime_error&) {
    // "nlopt failure", which LBFGS also says at an optimum
    if (optimiser.last_optimize_result() != nlopt::FAILURE) throw;
  }
  if (run.failure) std::rethrow_exception(run.failure);
}

struct Ended {
  Eigen::MatrixXd V;
  design::SearchStart start;
  std::vector<double> history;
};

/// From end.V, whose objective is known, down to where nothing improves.
void descend(const SearchProblem& problem, Ended& end) {
  for (int i = 0; i < max_charts && end.start.gradient_norm > gradient_vanishes * end.start.last; ++i) {
    const RowSpaceChart chart(end.V);
    Run run{problem, chart, end.history, end.start.last, Eigen::VectorXd(), end.start.gradient_norm, {}};
    minimise(run);
    if (run.best_at.size() == 0) break;
    const double before = end.start.last;
    end.V = chart.at(run.best_at);
    end.start.last = run.best;
    end.start.gradient_norm = run.gradient_norm;
    if (before - run.best <= improves * before) break;
  }
}

void go_to(const SearchProblem& problem, const Eigen::MatrixXd& V, Ended& end) {
  Eigen::MatrixXd gradient;
  end.V = V;
  end.start.last = objective(problem, V, &gradient);
  end.start.gradient_norm = gradient.norm();
  end.history.push_back(end.history.empty() ? end.start.last : std::min(end.history.back(), end.start.last));
}

Ended search_from(const SearchProblem& problem, const NamedTuners& start) {
  Ended end{{}, {start.name}, {}};
  go_to(problem, row_space(start.V), end);
  end.start.first = end.start.last;
  if (end.V.rows() < end.V.cols()) {
    descend(problem, end);
    for (Eigen::Index i = 0; i < end.V.rows(); ++i) {
      const std::optional<Eigen::MatrixXd> other = without_blind_tuner(problem, end.V);
      if (!other) break;
      Ended again = end;
      go_to(problem, *other, again);
      descend(problem, again);
      if (!(again.start.last < end.start.last)) break;
      end = std::move(again);
    }
  }
  end.start.evaluations = static_cast<int>(end.history.size());
  return end;
}

void check(const SearchProblem& problem, const std::vector<NamedTuners>& starts) {
  if (problem.points.empty()) throw std::invalid_argument("search: no operating point");
  if (starts.empty()) throw std::invalid_argument("search: no start");
  const Eigen::Index p = problem.points.front().problem.Gh.rows(), t = starts.front().V.rows();
  for (const SearchPoint& point : problem.points) {
    if (point.problem.Gh.rows() != p)
      throw std::invalid_argument("search: the points have different health parameters");
    if (!(point.weight > 0.0)) throw std::invalid_argument("search: a point's weight is not above zero");
    if (point.problem.H.rows() < t)
      throw std::invalid_argument("search: more tuners than sensors at one of the points");
  }
  for (const NamedTuners& start : starts) {
    if (start.V.rows() != t || start.V.cols() != p)
      throw std::invalid_argument("search: start " + start.name + " has another shape");
  }
}

}  // namespace

double objective(const SearchProblem& problem, const Eigen::MatrixXd& V, Eigen::MatrixXd* gradient) {
  double sum = 0.0, weights = 0.0;
  Eigen::MatrixXd one;
  if (gradient != nullptr) gradient->setZero(V.rows(), V.cols());
  for (const SearchPoint& point : problem.points) {
    Eigen::MatrixXd* part = gradient != nullptr ? &one : nullptr;
    const std::optional<double> value = problem.estimator == Estimator::map
                                            ? map_objective(point.problem, V, part)
                                            : kalman_objective(point.problem, V, problem.qh_percent2, part);
    if (!value || !(*value < no_filter)) {
      if (gradient != nullptr) gradient->setZero();
      return no_filter;
    }
    sum += point.weight * *value;
    weights += point.weight;
    if (gradient != nullptr) *gradient += point.weight * one;
  }
  if (gradient != nullptr) *gradient /= weights;
  return sum / weights;
}

std::vector<NamedTuners> random_tuners(Eigen::Index t, Eigen::Index p, int count, std::uint64_t seed) {
  // Row spaces of normal matrices.
  NoiseSource noise(seed);
  std::vector<NamedTuners> starts;
  for (int i = 1; i <= count; ++i) {
    Eigen::MatrixXd V(t, p);
    for (double& entry : V.reshaped()) entry = noise.normal();
    starts.push_back({"random " + std::to_string(i), std::move(V)});
  }
  return starts;
}

SearchResult search_tuners(const SearchProblem& problem, const SearchOptions& options) {
  std::vector<NamedTuners> starts = options.starts;
  check(problem, starts);
  const Eigen::MatrixXd& first = starts.front().V;
  if (first.rows() < first.cols()) {
    const auto more = random_tuners(first.rows(), first.cols(), options.random_starts, options.seed);
    starts.insert(starts.end(), more.begin(), more.end());
  }
  std::vector<Ended> ends(starts.size());
  long_work::parallel_for(
      starts.size(), options.threads, [&](std::size_t i) { ends[i] = search_from(problem, starts[i]); },
      [&](std::size_t done) { options.progress(static_cast<double>(done) / static_cast<double>(starts.size())); });

  double least = no_filter;
  for (const Ended& end : ends) least = std::min(least, end.start.last);
  if (!(least < no_filter)) throw estimation::SolverError("search: no start has a stable filter");
  // Of ends that differ by rounding only the first start's counts.
  const auto best = std::find_if(ends.begin(), ends.end(),
                                 [&](const Ended& end) { return end.start.last <= least * (1.0 + same_end); });
  SearchResult result;
  result.V = best->V;
  for (Ended& end : ends) {
    if (end.V.rows() < end.V.cols()) end.start.angle_rad = principal_angles(end.V, result.V)(0);
    result.starts.push_back(end.start);
    result.history.push_back(std::move(end.history));
  }
  return result;
}

}  // namespace ehm::tuner_design
