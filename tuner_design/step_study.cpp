#include "tuner_design/step_study.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace ehm::bench {
namespace {

constexpr double allowed_change = 1e-3;

/// Size of each input for a relative step: its trim, and 1 for a health fraction.
Eigen::VectorXd input_scale(const Eigen::VectorXd& v) {
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(engine_inputs);
  scale.head(engine_states + engine_controls) = v.head(engine_states + engine_controls);
  return scale;
}

/// Size of each output: its trim; a rate is measured against the speed's trim per second.
Eigen::VectorXd output_scale(const Eigen::VectorXd& f) {
  Eigen::VectorXd scale = f.cwiseAbs();
  scale.head(engine_rates) = scale.segment(engine_rates, engine_states);
  return scale;
}

Eigen::MatrixXd central_differences(const engine::Turbofan& turbofan, const engine::SteadyPoint& trim, double step) {
  const Eigen::VectorXd v = inputs_of(trim), scale = input_scale(v);
  Eigen::MatrixXd result(engine_outputs, engine_inputs);
  for (Eigen::Index j = 0; j < engine_inputs; ++j) {
    const Eigen::VectorXd delta = step * scale(j) * Eigen::VectorXd::Unit(engine_inputs, j);
    result.col(j) =
        (evaluate(turbofan, trim, v + delta) - evaluate(turbofan, trim, v - delta)) / (2.0 * step * scale(j));
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

StepStudy study_steps(const engine::Turbofan& turbofan, const engine::SteadyPoint& trim) {
  const Eigen::VectorXd output_size = output_scale(outputs_of(trim.gas));
  StepStudy study;
  Eigen::MatrixXd larger = central_differences(turbofan, trim, std::pow(10.0, -2.0));
  double least = std::numeric_limits<double>::infinity();
  for (int half_decade = 4; half_decade <= 15; ++half_decade) {
    const double step = std::pow(10.0, -0.5 * half_decade);
    const Eigen::MatrixXd smaller = central_differences(turbofan, trim, std::pow(10.0, -0.5 * (half_decade + 1)));
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

}  // namespace ehm::bench
