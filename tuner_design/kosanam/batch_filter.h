// SPDX-License-Identifier: Apache-2.0
#pragma once
// One filter of a study on one engine: predict, correct, and after each update the constraint of no improvement, by the
// code that flies (monitor/estimation/constrained). The box closes on the constrained health from the first sample on,
// as in the theses: a new engine, known to be new. What feeds back moves the states with the health, by Pxh Phh^-1 (W =
// P^-1 of all states), and by health alone for W = I.

#include <Eigen/Core>
#include <optional>
#include <string>

#include "monitor/estimation/constrained/health_constraint.h"
#include "tuner_design/kosanam/batch_problem.h"

namespace ehm::tuner_design {

enum class BatchWay { none, projection, identity, truncation };

/// What is tried.
struct FilterCase {
  std::string name;
  std::optional<SteadyFilter> steady;  ///< nothing: time-varying
  BatchWay way = BatchWay::none;
  bool feeds_back = false;
  double margin_sigma = 0.0;  ///< of the plain filter, by which the box stays behind
};

/// The gain of a sample, and the covariance after its update; not data's.
class TimeVaryingGain {
 public:
  explicit TimeVaryingGain(const BatchProblem& problem) : problem_(problem) { now_.P = problem.P0; }
  void step();
  const SteadyFilter& now() const { return now_; }

 private:
  const BatchProblem& problem_;
  SteadyFilter now_;
};

class BatchFilter {
 public:
  /// Both must outlive it. `direction`: where wear takes each parameter (health_constraint.h).
  BatchFilter(const BatchProblem& problem, const FilterCase& what, const Eigen::VectorXd& direction);

  /// One sample; `gain` is the case's own or the time-varying one.
  void take(const Eigen::VectorXd& y, const SteadyFilter& gain);
  /// Percent.
  const estimation::HealthVector& health() const { return health_; }
  const estimation::HealthVector& sigma() const { return sigma_; }

 private:
  void constrain(const SteadyFilter& gain);
  void feed_back(const SteadyFilter& gain);

  const BatchProblem& problem_;
  const FilterCase& case_;
  estimation::HealthConstraint constraint_;
  Eigen::VectorXd estimate_;
  estimation::HealthVector health_, sigma_;
};

}  // namespace ehm::tuner_design
