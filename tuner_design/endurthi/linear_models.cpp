// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/endurthi/linear_models.h"

#include <algorithm>

namespace ehm::tuner_design::endurthi {
namespace {

constexpr ColumnMethod methods[] = {ColumnMethod::perturbation, ColumnMethod::linmod, ColumnMethod::steady_state};

/// Outputs over their trims, rates over their states' trims.
Eigen::MatrixXd scaled(const Plant& plant, const Eigen::MatrixXd& jacobian) {
  Eigen::VectorXd outputs = plant.f0.cwiseAbs();
  outputs.head(plant.states) = plant.v0.head(plant.states);
  return outputs.cwiseInverse().asDiagonal() * jacobian;
}

bool alike(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double closeness) {
  return ((a - b).colwise().norm().array() <= closeness * b.colwise().norm().array()).all();
}

}  // namespace

std::string model_digits(std::size_t model) {
  return std::to_string(model / 9) + std::to_string(model / 3 % 3) + std::to_string(model % 3);
}

std::array<Eigen::MatrixXd, model_count> jacobians(const Plant& plant, const ColumnSteps& steps) {
  std::array<Eigen::MatrixXd, model_count> models;
  std::size_t model = 0;
  for (const ColumnMethod x : methods) {
    const Eigen::MatrixXd states = state_columns(plant, x, steps);
    std::array<Eigen::MatrixXd, 3> controls, health;
    for (std::size_t k = 0; k < 3; ++k) {
      controls[k] = control_columns(plant, methods[k], steps, states);
      health[k] = health_columns(plant, methods[k], steps, states);
    }
    for (std::size_t y = 0; y < 3; ++y) {
      for (std::size_t z = 0; z < 3; ++z) {
        Eigen::MatrixXd& jacobian = models[model++];
        jacobian.resize(plant.outputs(), plant.inputs());
        jacobian << states, controls[y], health[z];
      }
    }
  }
  return models;
}

std::vector<std::vector<std::size_t>> coinciding(const Plant& plant,
                                                 const std::array<Eigen::MatrixXd, model_count>& models,
                                                 double closeness) {
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < model_count; ++i) {
    const Eigen::MatrixXd own = scaled(plant, models[i]);
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const std::vector<std::size_t>& g) {
      return alike(own, scaled(plant, models[g.front()]), closeness);
    });
    if (group == groups.end())
      groups.push_back({i});
    else
      group->push_back(i);
  }
  return groups;
}

linear_model::LinearModel linear_model_of(const Plant& plant, const Eigen::MatrixXd& jacobian, double sample_time_s) {
  const Eigen::Index n = plant.states, m = plant.outputs() - n;
  linear_model::LinearModel model;
  model.discrete = false;
  model.sample_time_s = sample_time_s;
  model.A = jacobian.topLeftCorner(n, n);
  model.B = jacobian.block(0, plant.first_control(), n, plant.controls);
  model.L = jacobian.topRightCorner(n, plant.health);
  model.C = jacobian.bottomLeftCorner(m, n);
  model.D = jacobian.block(n, plant.first_control(), m, plant.controls);
  model.M = jacobian.bottomRightCorner(m, plant.health);
  return model;
}

}  // namespace ehm::tuner_design::endurthi
