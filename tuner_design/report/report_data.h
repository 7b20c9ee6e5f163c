// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the sections of a report draw from: the design, and what follows from it. Scaled units throughout
// (engine_sim/linear_model/scaling.h): health and sensors in percent, auxiliary outputs in their reporting unit.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "monitor/design/design.h"
#include "monitor/estimation/steady_gain.h"
#include "tuner_design/report/studies.h"

namespace ehm::tuner_design::report {

/// Variances by channel; unseen + noise + linearisation = total.
struct ErrorParts {
  Eigen::VectorXd unseen;         ///< diag G Ph G^T: what the sensors cannot tell, over the fleet
  Eigen::VectorXd noise;          ///< diag T S T^T
  Eigen::VectorXd linearisation;  ///< what the linear model misses of the engine
  Eigen::VectorXd total;          ///< as published
  Eigen::VectorXd prior;          ///< of the fleet: the error of an estimator that has no sensors
  Eigen::VectorXd limit;          ///< Bayes limit
};

struct ReportData {
  design::Design design;
  Studies studies;
  linear_model::LinearModel model;  ///< discrete and scaled
  estimation::SteadyGain steady;    ///< of `model`
  ErrorParts health, auxiliary;
  Eigen::MatrixXd
      settled;  ///< p x p, percent: column j is the estimate that remains of one sigma of health parameter j
};

/// @throws std::runtime_error if I - A of the model or of the filter is singular.
ReportData report_data(design::Design design, Studies studies);

inline std::vector<double> values_of(const Eigen::VectorXd& vector) {
  return {vector.begin(), vector.end()};
}

}  // namespace ehm::tuner_design::report
