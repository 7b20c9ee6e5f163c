// SPDX-License-Identifier: Apache-2.0
#pragma once
// How health wears over the flights of the theses' studies (endurthi/, kosanam/) and of the family, percent of nominal;
// Lu's gradual wear is its paper's own:
//   h(k) = -a (1 - exp(-k/tau)) - b k,   k in flights since new
// a and b by parameter through the wear table at 3000 and 6000 cycles (engine_sim/scenario/life.h), tau 240 cycles.
// *Reading*: the theses give neither law nor size, only that it is exponential and reaches some percent; 12 cycles a
// flight let 500 flights reach the table's end. Errors: none; a parameter that is not in the table wears as
// fan_efficiency does, and not_known says so.

#include <Eigen/Core>
#include <string>
#include <vector>

namespace ehm::tuner_design {

struct WearLaw {
  Eigen::VectorXd early, late;         ///< a, percent; b, percent a flight
  double early_flights = 1.0;          ///< tau
  Eigen::VectorXd direction;           ///< +1 where wear raises it, -1
  std::vector<std::string> not_known;  ///< by the table

  Eigen::VectorXd at(double flight) const;
};

/// `equal_percent`: what each parameter has lost or gained after 6000 cycles, in place of the table's; 0: the table's.
WearLaw wear_law(const std::vector<std::string>& health, double cycles_a_flight, double equal_percent = 0.0);

}  // namespace ehm::tuner_design
