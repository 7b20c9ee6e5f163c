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
Eigen::VectorXd output_scale(const EngineLayout& layout, const Eigen::VectorXd& v, const Eigen::VectorXd& f) {
  Eigen::VectorXd scale = f.cwiseAbs();
  scale.head(layout.states()) = v.head(layout.states());
  return scale;
}

Eigen::MatrixXd differences(const EngineLayout& layout, const engine_sim::Turbofan& turbofan,
                            const engine_sim::SteadyPoint& trim, double relative_step) {
  const Eigen::VectorXd v = inputs_of(layout, trim), size = input_size(layout, v), lowest = lowest_inputs(layout);
  const auto f = [&](const Eigen::VectorXd& at) { return evaluate(layout, turbofan, trim, at); };
  Eigen::MatrixXd result(layout.outputs(), layout.inputs());
  for (Eigen::Index j = 0; j < layout.inputs(); ++j) {
    const double step = relative_step * size(j);
    const Eigen::VectorXd s = step * Eigen::VectorXd::Unit(layout.inputs(), j);
    if (v(j) - step < lowest(j))
      result.col(j) = (-3.0 * f(v) + 4.0 * f(v + s) - f(v + 2.0 * s)) / (2.0 * step);
    else
      result.col(j) = (f(v + s) - f(v - s)) / (2.0 * step);
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

StepStudy study_steps(const EngineLayout& layout, const engine_sim::Turbofan& turbofan,
                      const engine_sim::SteadyPoint& trim) {
  const Eigen::VectorXd output_size = output_scale(layout, inputs_of(layout, trim), outputs_of(layout, trim.gas));
  StepStudy study;
  Eigen::MatrixXd larger = differences(layout, turbofan, trim, std::pow(10.0, -2.0));
  double least = std::numeric_limits<double>::infinity();
  for (int half_decade = 4; half_decade <= 15; ++half_decade) {
    const double step = std::pow(10.0, -0.5 * half_decade);
    const Eigen::MatrixXd smaller = differences(layout, turbofan, trim, std::pow(10.0, -0.5 * (half_decade + 1)));
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
