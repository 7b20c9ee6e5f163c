// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <sstream>

#include "deploy/runtime/numbers/decompositions.h"
#include "tuner_design/search/row_space.h"
#include "tuner_design/search/tuner_search.h"

namespace ehm::tuner_design {
namespace {

constexpr double gain_is_nothing = 1e-8;    ///< of J
constexpr double starts_agree = 1e-6;       ///< of J
constexpr double near_the_limit = 1.1;      ///< J over the limit's, of a design that was not searched
constexpr double curvature_is_flat = 1e-7;  ///< of the largest

/// Hessian of J on the row spaces at V, by central differences of the gradient: symmetric, t (p - t) square. In the
/// chart centred on V its error is of second order in the step.
Eigen::MatrixXd hessian(const SearchProblem& problem, const RowSpaceChart& chart) {
  constexpr double step = 1e-5;
  const Eigen::Index size = chart.dimension();
  Eigen::MatrixXd result(size, size), T, V_gradient;
  const auto gradient_at = [&](const Eigen::VectorXd& x) {
    const Eigen::MatrixXd V = chart.at(x, &T);
    objective(problem, V, &V_gradient);
    return chart.gradient(V_gradient, T);
  };
  for (Eigen::Index i = 0; i < size; ++i) {
    const Eigen::VectorXd x = step * Eigen::VectorXd::Unit(size, i);
    result.col(i) = (gradient_at(x) - gradient_at(-x)) / (2.0 * step);
  }
  return 0.5 * (result + result.transpose());
}

void add_curvature(design::Certificate& certificate, const SearchProblem& problem, const Eigen::MatrixXd& V) {
  if (V.rows() == V.cols()) return;
  const RowSpaceChart chart(V);
  Eigen::MatrixXd T, V_gradient;
  objective(problem, chart.at(Eigen::VectorXd::Zero(chart.dimension()), &T), &V_gradient);
  const Eigen::VectorXd g = chart.gradient(V_gradient, T);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(hessian(problem, chart));
  const Eigen::VectorXd& values = spectrum.eigenvalues();
  certificate.gradient_norm = V_gradient.norm();
  certificate.least_curvature = values.minCoeff();
  certificate.largest_curvature = values.maxCoeff();
  const Eigen::VectorXd along = spectrum.eigenvectors().transpose() * g;
  const double flat = curvature_is_flat * values.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (std::abs(values(i)) <= flat) {
      ++certificate.flat_directions;
    } else {
      certificate.possible_gain += 0.5 * along(i) * along(i) / std::abs(values(i));
    }
  }
}

/// SSEE over limit of health and of the auxiliary outputs at one point.
std::pair<double, double> ratios(const SearchProblem& problem, const SearchPoint& point, const Eigen::MatrixXd& V) {
  SearchProblem one{{point}, problem.estimator, problem.qh_percent2};
  PointProblem& part = one.points.front().problem;
  part.health_weight = 1.0 / part.health_limit;
  part.auxiliary_weight.setZero();
  const double health = objective(one, V);
  part.health_weight = 0.0;
  part.auxiliary_weight = part.auxiliary_ratio;
  return {health, objective(one, V)};
}

void decide(design::Certificate& c, bool nothing_to_choose, bool not_searched) {
  std::ostringstream text;
  text.precision(3);
  c.at_optimum = false;
  if (not_searched) {
    c.at_optimum = c.objective <= near_the_limit * c.lower_bound;
    text
        << "not searched: the estimate of least error is read off these tuners, and no others could gain more than the "
        << 100.0 * (c.objective / c.lower_bound - 1.0) << " % that are left to the limit";
  } else if (nothing_to_choose) {
    c.at_optimum = true;
    text << "nothing to choose: as many tuners as health parameters";
  } else if (!(c.possible_gain <= gain_is_nothing * c.objective)) {
    text << "not at an optimum: the slope promises a gain of " << 100.0 * c.possible_gain / c.objective << " %";
  } else if (c.least_curvature < -curvature_is_flat * c.largest_curvature) {
    text << "not at an optimum: a saddle, least curvature " << c.least_curvature;
  } else {
    c.at_optimum = true;
    text << "at an optimum: no slope, no descending direction";
    if (c.flat_directions > 0) text << ", " << c.flat_directions << " flat ones";
  }
  if (!nothing_to_choose && !c.starts.empty()) {
    const auto agree = std::count_if(c.starts.begin(), c.starts.end(), [&](const design::SearchStart& start) {
      return std::abs(start.last / c.objective - 1.0) <= starts_agree;
    });
    text << "; " << agree << " of " << c.starts.size() << " starts end there";
  }
  c.verdict = text.str();
}

}  // namespace

bool read_off(const SearchProblem& problem) {
  return problem.estimator == Estimator::kalman &&
         std::all_of(problem.points.begin(), problem.points.end(),
                     [](const SearchPoint& point) { return point.problem.own_readout; });
}

void certify(design::Certificate& certificate, const SearchProblem& problem, const Eigen::MatrixXd& V) {
  certificate.objective = objective(problem, V);
  certificate.lower_bound = 0.0;
  double weights = 0.0;
  certificate.points.clear();
  for (const SearchPoint& point : problem.points) {
    const PointProblem& p = point.problem;
    const auto [health, auxiliary] = ratios(problem, point, V);
    certificate.points.push_back({p.name, point.weight, health, auxiliary});
    certificate.lower_bound += point.weight * p.lower_bound;
    certificate.limit_is_prior = certificate.limit_is_prior || p.limit_is_prior;
    weights += point.weight;
  }
  certificate.lower_bound /= weights;
  if (read_off(problem)) {
    certificate.possible_gain = certificate.objective - certificate.lower_bound;
  } else {
    add_curvature(certificate, problem, V);
  }
  decide(certificate, V.rows() == V.cols(), read_off(problem));
}

}  // namespace ehm::tuner_design
