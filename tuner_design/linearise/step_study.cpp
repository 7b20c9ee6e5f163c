// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/linearise/step_study.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace ehm::tuner_design {
namespace {

constexpr double allowed_change = 1e-3;

/// Size of each output: its trim; a rate is measured against its state's trim per second.
Eigen::VectorXd output_scale(const Plant& plant) {
  Eigen::VectorXd scale = plant.f0.cwiseAbs();
  scale.head(plant.states) = plant.v0.head(plant.states);
  return scale;
}

Eigen::MatrixXd differences(const Plant& plant, double relative_step) {
  Eigen::MatrixXd result(plant.outputs(), plant.inputs());
  for (Eigen::Index j = 0; j < plant.inputs(); ++j) {
    const double step = relative_step * plant.size(j);
    const auto f_at = [&](double by) { return plant.f(plant.moved(j, by)); };
    if (plant.v0(j) - step < plant.lowest(j))
      result.col(j) = (-3.0 * plant.f0 + 4.0 * f_at(step) - f_at(2.0 * step)) / (2.0 * step);
    else
      result.col(j) = (f_at(step) - f_at(-step)) / (2.0 * step);
  }
  return result;
}

/// Largest relative change of a column between two scaled Jacobians.
double largest_change(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const Eigen::VectorXd& output_size) {
  double largest = 0.0;
  for (Eigen::Index j = 0; j < a.cols(); ++j) {
    const Eigen::VectorXd difference = (a.col(j) - b.col(j)).cwiseQuotient(output_size);
    largest = std::max(largest, difference.norm() / b.col(j).cwiseQuotient(output_size).norm());
  }
  return largest;
}

}  // namespace

StepStudy study_steps(const Plant& plant) {
  const Eigen::VectorXd output_size = output_scale(plant);
  StepStudy study;
  Eigen::MatrixXd larger = differences(plant, std::pow(10.0, -2.0));
  double least = std::numeric_limits<double>::infinity();
  for (int half_decade = 4; half_decade <= 15; ++half_decade) {
    const double step = std::pow(10.0, -0.5 * half_decade);
    const Eigen::MatrixXd smaller = differences(plant, std::pow(10.0, -0.5 * (half_decade + 1)));
    const double change = largest_change(larger, smaller, output_size);
    study.rows.push_back({step, change});
    if (change < least) {
      least = change;
      study.step = step;
      study.jacobian = larger;
    }
    larger = smaller;
  }
  if (!(least <= allowed_change)) {
    std::ostringstream message;
    message << "linearise: no step gives settled derivatives; the least relative change between neighbours is " << least
            << ", allowed " << allowed_change << "; the operating point may lie on a limit (choking, map edge)";
    throw std::runtime_error(message.str());
  }
  return study;
}

}  // namespace ehm::tuner_design
