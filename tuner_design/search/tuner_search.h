// SPDX-License-Identifier: Apache-2.0
#pragma once
// Minimises J over row spaces, for one or several operating points with one V (an envelope):
//   J(V) = sum_i weight_i J_i(V) / sum_i weight_i          J_i: kalman_objective.h or map_objective.h
// NLopt's LD_LBFGS in the coordinates of a chart (row_space.h); the chart is centred anew on the best point after some
// 40 evaluations, until the gradient vanishes or nothing improves; a blind tuner is then replaced (blind_tuner.h), and
// the descent goes on. Starts: the given ones and `random_starts` seeded random row spaces; they are independent, so
// that the result is the same on any number of threads. The Hessian at the best point, by differences of gradients,
// tells a minimum from a saddle and what could still be gained.
// Source: theory.md, sections 5, 6, 10.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "monitor/design/certificate.h"
#include "tuner_design/theory/point_problem.h"

namespace ehm::tuner_design {

enum class Estimator { kalman, map };

struct SearchPoint {
  PointProblem problem;
  double weight = 1.0;
};

struct SearchProblem {
  std::vector<SearchPoint> points;
  Estimator estimator = Estimator::kalman;
  double qh_percent2 = 1e-3;  ///< Kalman filter only
};

/// At every point the filter's estimates are read off with least error: J hardly knows V, and nothing is searched.
bool read_off(const SearchProblem& problem);

/// J of orthonormal rows V; a large finite number where a filter has no solution, with a gradient of zero.
double objective(const SearchProblem& problem, const Eigen::MatrixXd& V, Eigen::MatrixXd* gradient = nullptr);

struct NamedTuners {
  std::string name;
  Eigen::MatrixXd V;  ///< full row rank
};

/// Seeded row spaces, uniform on the Grassmannian, named "random 1" and so on; t x p.
std::vector<NamedTuners> random_tuners(Eigen::Index t, Eigen::Index p, int count, std::uint64_t seed);

struct SearchOptions {
  std::vector<NamedTuners> starts;
  int random_starts = 8;
  std::uint64_t seed = 1;
  unsigned threads = 1;
  std::function<void(double)> progress = [](double) {};  ///< share of the starts that are done
};

struct SearchResult {
  Eigen::MatrixXd V;  ///< orthonormal rows
  std::vector<design::SearchStart> starts;
  std::vector<std::vector<double>> history;  ///< [start]: best J after each evaluation
};

/// @throws std::invalid_argument if there is no point, no start, or shapes do not fit.
/// @throws SolverError if no start has a filter.
SearchResult search_tuners(const SearchProblem& problem, const SearchOptions& options);

/// Fills what a certificate says about J at V: objective, lower bound, gradient, curvature, possible gain, verdict,
/// points; `starts` must be there already (none: V was not searched).
void certify(design::Certificate& certificate, const SearchProblem& problem, const Eigen::MatrixXd& V);

}  // namespace ehm::tuner_design
