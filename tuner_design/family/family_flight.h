// SPDX-License-Identifier: Apache-2.0
#pragma once
// One engine of one case of the family study (family_study.h), and all estimators on its samples.
// Errors: none; an engine that does not fly to the end has no outcome. The same seed and index give the same flight.

#include <memory>
#include <optional>
#include <vector>

#include "monitor/estimation/estimator.h"
#include "tuner_design/family/family_study.h"

namespace ehm::tuner_design {

/// Of one estimator; sums over what was judged.
struct FamilyOutcome {
  double samples = 0, held = 0, squares = 0, claims = 0;  ///< percent^2
  double judged = 0, covered = 0;                         ///< health estimates
  Eigen::ArrayXd errors;                                  ///< of each parameter, summed; percent
  Eigen::ArrayXd covered_of;                              ///< of each parameter
  std::optional<double> answer_s;
  double step_s = 0.0;  ///< what the estimator took of a sample, median: of the clock, no part of the result
};

/// What a case flies, and who.
struct FamilyFleet {
  FamilyCase what;
  engine_sim::EngineDefinition engine;  ///< with the lags and noise of its samples
  linear_model::OperatingPoint point;
  double fan_speed_rpm = 0.0, step_s = 0.015;
  Eigen::VectorXd health_sigma;                                      ///< fraction
  std::vector<std::shared_ptr<const estimation::Estimator>> fliers;  ///< null: has no part in this case
};

std::optional<std::vector<FamilyOutcome>> fly_family(const FamilyFleet& fleet, std::uint64_t seed, std::size_t index);

}  // namespace ehm::tuner_design
