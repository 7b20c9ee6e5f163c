// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/linearise/open_loop.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "deploy/runtime/numbers/decompositions.h"

namespace ehm::tuner_design {
namespace {

constexpr double longest_step_s = 0.005;
constexpr int most_newton_steps = 50;
constexpr double slope_step = 1e-5, at_rest = 1e-10;  ///< of the states' size

Eigen::VectorXd rates(const Plant& plant, const Eigen::VectorXd& v) {
  return plant.f(v).head(plant.states);
}

/// d(dx/dt)/dx at v.
Eigen::MatrixXd rate_slopes(const Plant& plant, const Eigen::VectorXd& v) {
  Eigen::MatrixXd slopes(plant.states, plant.states);
  for (Eigen::Index j = 0; j < plant.states; ++j) {
    const double step = slope_step * plant.size(j);
    Eigen::VectorXd up = v, down = v;
    up(j) += step;
    down(j) -= step;
    slopes.col(j) = (rates(plant, up) - rates(plant, down)) / (2.0 * step);
  }
  return slopes;
}

}  // namespace

Eigen::VectorXd after(const Plant& plant, Eigen::VectorXd v, double seconds) {
  const int steps = std::max(1, static_cast<int>(std::ceil(seconds / longest_step_s)));
  const double dt = seconds / steps;
  const auto at = [&](const Eigen::VectorXd& slope, double share) {
    Eigen::VectorXd moved = v;
    moved.head(plant.states) += share * dt * slope;
    return rates(plant, moved);
  };
  for (int k = 0; k < steps; ++k) {
    const Eigen::VectorXd k1 = rates(plant, v), k2 = at(k1, 0.5), k3 = at(k2, 0.5), k4 = at(k3, 1.0);
    v.head(plant.states) += dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  return v;
}

Eigen::VectorXd settled(const Plant& plant, Eigen::VectorXd v) {
  const Eigen::Index n = plant.states;
  for (int step = 0; step < most_newton_steps; ++step) {
    const Eigen::VectorXd dx = rate_slopes(plant, v).partialPivLu().solve(rates(plant, v));
    if (!dx.allFinite()) break;
    v.head(n) -= dx;
    if ((dx.cwiseAbs().array() <= at_rest * plant.size.head(n).array().abs()).all()) return v;
  }
  throw std::runtime_error(
      "linearise: the engine does not come to rest after a step of a control or of health; take a "
      "smaller perturbation, or a point further from a limit");
}

}  // namespace ehm::tuner_design
