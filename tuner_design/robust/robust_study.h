// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a robust gain (robust_gain.h) buys on a model, after Kosanam's tables 5.2 and 5.3: error of health of the
// standard and of the robust filter where the sensors' noise is as the model says, and where its variance is nine times
// as large (his "two standard deviations" read so: STUDIES of the thesis in deploy/docs/studies.md).
//
// The filter's states are those of the tuner filter, [x; q], so that a model with fewer sensors than health parameters
// can be tried; W weighs the health that q stands for, in percent. Errors are root mean squares of each parameter's
// estimate after the update, by one Lyapunov equation: exact, no Monte Carlo. What the tuners do not span is the same for
// every gain, and left out.
//   common      one factor mu on all sensors' noise, as large as costs `nominal_loss` where nothing is wrong
//   by sensor   the same price, all of it spent on the sensor that is in doubt
// Scaled units: percent. Errors: @throws what prepare, kalman_gain and robust_gain throw.

#include <string>
#include <vector>

#include "engine_sim/linear_model/linear_model.h"
#include "tuner_design/robust/robust_gain.h"

namespace ehm::tuner_design {

struct RobustStudyOptions {
  double qh_percent2 = 1e-3;   ///< process noise of health a sample
  double nominal_loss = 0.05;  ///< of the mean error, that the robust gain may cost where nothing is wrong
  double noise_factor = 9.0;   ///< of the sensors' variance, where it is wrong
};

/// Root mean square errors of each health parameter, percent; the last is their mean.
using HealthErrors = std::vector<double>;

struct DoubtedSensor {
  std::string sensor;
  double standard = 0.0, common = 0.0, own = 0.0;  ///< mean errors where only this sensor's noise is wrong
};

struct RobustStudy {
  RobustStudyOptions options;
  std::string model;
  std::vector<std::string> health;
  Eigen::Index tuners = 0;
  double mu = 1.0;                            ///< common
  double rho2_s2 = 0.0;                       ///< rho2 s2^2 / rho1 of which mu is the optimum, 1/percent^2
  HealthErrors standard, robust;              ///< noise as the model says
  HealthErrors standard_wrong, robust_wrong;  ///< all sensors' noise wrong
  std::vector<DoubtedSensor> by_sensor;
  std::vector<RobustTrade> trade;  ///< 100 points

  double nominal_ratio() const { return robust.back() / standard.back(); }
  double wrong_ratio() const { return robust_wrong.back() / standard_wrong.back(); }
};

RobustStudy run_robust_study(const linear_model::LinearModel& model, const RobustStudyOptions& options);

}  // namespace ehm::tuner_design
