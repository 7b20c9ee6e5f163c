// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/linearise/block_columns.h"

#include <cmath>

#include "deploy/runtime/numbers/decompositions.h"
#include "tuner_design/linearise/open_loop.h"

namespace ehm::tuner_design {
namespace {

/// Of input j, to the other side where it may not be less.
double step_of(const Plant& plant, const ColumnSteps& steps, Eigen::Index j) {
  const double step = steps.relative * plant.size(j);
  return plant.v0(j) + step < plant.lowest(j) ? -step : step;
}

double linmod_step(double value) {
  return 1e-5 * (1.0 + 1e-3 * std::abs(value));
}

Eigen::VectorXd one_sided(const Plant& plant, Eigen::Index j, double step) {
  return (plant.f(plant.moved(j, step)) - plant.f0) / step;
}

Eigen::VectorXd perturbed(const Plant& plant, const ColumnSteps& steps, Eigen::Index j) {
  const double step = step_of(plant, steps, j);
  if (!steps.central || plant.v0(j) - std::abs(step) < plant.lowest(j)) return one_sided(plant, j, step);
  return (plant.f(plant.moved(j, step)) - plant.f(plant.moved(j, -step))) / (2.0 * step);
}

/// Columns of `count` inputs from `first`, each by itself.
template <class Column>
Eigen::MatrixXd columns_of(const Plant& plant, Eigen::Index first, Eigen::Index count, const Column& column) {
  Eigen::MatrixXd columns(plant.outputs(), count);
  for (Eigen::Index j = 0; j < count; ++j) columns.col(j) = column(first + j);
  return columns;
}

/// [dF1 .. dFn] [dX1 .. dXn]^-1
Eigen::MatrixXd response_columns(const Plant& plant, const ColumnSteps& steps) {
  const Eigen::Index n = plant.states;
  Eigen::MatrixXd dX(n, n), dF(plant.outputs(), n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::VectorXd v = after(plant, plant.moved(i, step_of(plant, steps, i)), steps.response_s);
    dX.col(i) = (v - plant.v0).head(n);
    dF.col(i) = plant.f(v) - plant.f0;
  }
  return dX.transpose().partialPivLu().solve(dF.transpose()).transpose();
}

/// ( dFss - [A; C] dXss ) / s
Eigen::VectorXd settled_column(const Plant& plant, const ColumnSteps& steps, const Eigen::MatrixXd& states,
                               Eigen::Index j) {
  const double step = step_of(plant, steps, j);
  const Eigen::VectorXd v = settled(plant, plant.moved(j, step));
  return (plant.f(v) - plant.f0 - states * (v - plant.v0).head(plant.states)) / step;
}

Eigen::MatrixXd input_columns(const Plant& plant, ColumnMethod method, const ColumnSteps& steps,
                              const Eigen::MatrixXd& states, Eigen::Index first, Eigen::Index count) {
  return columns_of(plant, first, count, [&](Eigen::Index j) -> Eigen::VectorXd {
    if (method == ColumnMethod::perturbation) return perturbed(plant, steps, j);
    if (method == ColumnMethod::linmod) return one_sided(plant, j, linmod_step(plant.v0(j)));
    return settled_column(plant, steps, states, j);
  });
}

}  // namespace

Eigen::MatrixXd state_columns(const Plant& plant, ColumnMethod method, const ColumnSteps& steps) {
  if (method == ColumnMethod::steady_state) return response_columns(plant, steps);
  return input_columns(plant, method, steps, {}, 0, plant.states);
}

Eigen::MatrixXd control_columns(const Plant& plant, ColumnMethod method, const ColumnSteps& steps,
                                const Eigen::MatrixXd& states) {
  return input_columns(plant, method, steps, states, plant.first_control(), plant.controls);
}

Eigen::MatrixXd health_columns(const Plant& plant, ColumnMethod method, const ColumnSteps& steps,
                               const Eigen::MatrixXd& states) {
  return input_columns(plant, method, steps, states, plant.first_health(), plant.health);
}

}  // namespace ehm::tuner_design
