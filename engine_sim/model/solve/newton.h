// SPDX-License-Identifier: Apache-2.0
#pragma once
// Damped Newton's method for N equations in N unknowns, both scaled to order one:
//   J(x) dx = -r(x),  x <- x + a dx,  a halved until max|r| falls (or is small already)
// J is the exact derivative from dual numbers; it is factorised by LU with partial pivoting, never inverted.
// Shapes: x, r of N. Each component of a step is limited to `largest_step`, so that the maps are left slowly.
// Errors: newton() @throws SolveError, naming the largest residual and its value, if max|r| does not fall below the
// tolerance; try_newton() tells the same as a value.
// Source: Dennis & Schnabel, Numerical Methods for Unconstrained Optimization and Nonlinear Equations, chapter 6.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"
#include "engine_sim/model/solve/dual.h"

namespace ehm::engine_sim {

/// The engine's balances could not be closed; the message names the residual that did not close and its value.
class SolveError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

template <std::size_t N>
struct NewtonProblem {
  std::array<std::string_view, N> residual_names;
  std::array<double, N> lower, upper, largest_step;
  double tolerance = 1e-11;  ///< on max|r|
  int max_iterations = 40;
  int max_evaluations = std::numeric_limits<int>::max();  ///< for who must have an answer in time
};

struct NewtonReport {
  int iterations;
  double residual;  ///< max|r| at the solution
};

/// How an attempt ended; `worst`: the residual that did not close, the first that is not finite or else the largest.
struct NewtonEnd {
  bool closed;
  NewtonReport report;
  std::size_t worst = 0;
  double worst_value = 0.0;
};

namespace newton_detail {

template <std::size_t N>
double largest(const std::array<Dual<N>, N>& r) {
  double worst = 0.0;
  for (const Dual<N>& ri : r) {
    if (!std::isfinite(ri.v)) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, std::abs(ri.v));
  }
  return worst;
}

template <std::size_t N>
NewtonEnd not_closed(const std::array<Dual<N>, N>& r, int iterations, double norm) {
  std::size_t worst = 0;
  for (std::size_t i = 0; i < N; ++i) {
    if (!std::isfinite(r[i].v) || std::abs(r[i].v) > std::abs(r[worst].v)) worst = i;
    if (!std::isfinite(r[worst].v)) break;
  }
  return {false, {iterations, norm}, worst, r[worst].v};
}

/// The full Newton step, shortened as a whole where a component would exceed its largest step.
template <std::size_t N>
Eigen::Matrix<double, N, 1> limited_step(const NewtonProblem<N>& problem, const std::array<Dual<N>, N>& r) {
  constexpr int n = static_cast<int>(N);
  Eigen::Matrix<double, n, n> jacobian;
  Eigen::Matrix<double, n, 1> right;
  for (int i = 0; i < n; ++i) {
    const Dual<N>& ri = r[as_size(i)];
    right(i) = -ri.v;
    for (int j = 0; j < n; ++j) jacobian(i, j) = ri.d[as_size(j)];
  }
  Eigen::Matrix<double, n, 1> step = jacobian.partialPivLu().solve(right);
  double excess = 1.0;
  for (int i = 0; i < n; ++i) excess = std::max(excess, std::abs(step(i)) / problem.largest_step[as_size(i)]);
  return step / excess;
}

}  // namespace newton_detail

/// `residuals(x)` maps std::array<Dual<N>, N> of unknowns to std::array<Dual<N>, N>; x is start and solution.
/// The last evaluation is the one at the solution, so a caller may keep what it computed there.
template <std::size_t N, class Residuals>
NewtonEnd try_newton(const NewtonProblem<N>& problem, std::array<double, N>& x, Residuals&& residuals) {
  using namespace newton_detail;
  int evaluations = 0;
  const auto evaluate = [&](const std::array<double, N>& at) {
    ++evaluations;
    std::array<Dual<N>, N> seeded;
    for (std::size_t i = 0; i < N; ++i) seeded[i] = Dual<N>::variable(at[i], i);
    return residuals(seeded);
  };
  std::array<Dual<N>, N> r = evaluate(x);
  double norm = largest(r);
  for (int iteration = 0; iteration < problem.max_iterations; ++iteration) {
    if (norm < problem.tolerance) return {true, {iteration, norm}};
    if (!std::isfinite(norm) || evaluations >= problem.max_evaluations) return not_closed(r, iteration, norm);
    const Eigen::Matrix<double, static_cast<int>(N), 1> step = limited_step(problem, r);
    if (!step.allFinite()) return not_closed(r, iteration, norm);
    double damping = 1.0;
    for (int halving = 0;; ++halving, damping *= 0.5) {
      std::array<double, N> trial;
      for (std::size_t i = 0; i < N; ++i) {
        trial[i] = std::clamp(x[i] + damping * step(static_cast<int>(i)), problem.lower[i], problem.upper[i]);
      }
      const std::array<Dual<N>, N> r_trial = evaluate(trial);
      const double trial_norm = largest(r_trial);
      // the last halving is taken as it is, if finite: a longer way round often helps
      if (trial_norm < norm || (halving == 6 && std::isfinite(trial_norm))) {
        x = trial;
        r = r_trial;
        norm = trial_norm;
        break;
      }
      if (halving == 12 || evaluations >= problem.max_evaluations) return not_closed(r, iteration, norm);
    }
  }
  if (norm < problem.tolerance) return {true, {problem.max_iterations, norm}};
  return not_closed(r, problem.max_iterations, norm);
}

template <std::size_t N>
[[noreturn]] void throw_not_closed(const NewtonProblem<N>& problem, const NewtonEnd& end) {
  throw SolveError("engine balance did not close after " + std::to_string(end.report.iterations) +
                   " iterations: residual '" + std::string(problem.residual_names[end.worst]) +
                   "' = " + std::to_string(end.worst_value) + " of its flow, power or demand");
}

/// As try_newton().
template <std::size_t N, class Residuals>
NewtonReport newton(const NewtonProblem<N>& problem, std::array<double, N>& x, Residuals&& residuals) {
  const NewtonEnd end = try_newton(problem, x, std::forward<Residuals>(residuals));
  if (!end.closed) throw_not_closed(problem, end);
  return end.report;
}

}  // namespace ehm::engine_sim
