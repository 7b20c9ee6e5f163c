// SPDX-License-Identifier: Apache-2.0
#pragma once
// What Endurthi planned and never ran (estimated there at 472 hours): the unscented filter on the turbofan itself over 50
// flights, beside the extended one, on the engine, the points, the wear and the flights of health_study.h; the same
// noise for both. Of the eleven sensors the metal's temperature has no place: it is no quantity of the gas path.
// Seconds are of the clock and of one core, for all runs of a point. Errors: those of the engine.

#include "tuner_design/endurthi/health_study.h"

namespace ehm::tuner_design::endurthi {

struct TurbofanFilter {
  std::string name;
  HealthErrors errors;  ///< by health parameter, and their mean
  double seconds = 0.0, coverage = 0.0;
  std::size_t lost = 0;  ///< samples without an answer
};

struct TurbofanPoint {
  std::string name;
  std::vector<std::string> health;
  std::vector<TurbofanFilter> filters;
};

/// `options.runs` runs of `options.flights` flights.
std::vector<TurbofanPoint> run_ukf_turbofan(const HealthStudyOptions& options);

}  // namespace ehm::tuner_design::endurthi
