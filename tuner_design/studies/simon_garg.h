// SPDX-License-Identifier: Apache-2.0
#pragma once
// The experiment of Simon & Garg, NASA/TM-2010-216077, tables 4 to 7, on any engine with their ten health parameters.
//   rows a to d    tuners searched for the least MAP error of health alone, each from its own random start
//   rows e to h    the same for the auxiliary outputs alone, which leaves combinations of health free
//   beside them    what the paper compares with (MAP on all health parameters, or the Kalman filter on a subset), and
//                  what it lacks: the closed form H Ph, the search for the least error of the Kalman filter itself, and
//                  the Bayes limit
// Tables 4 and 5 are MAP on one noisy snapshot, 6 and 7 the Kalman filter over the last 10 of 30 s. Theory is that of
// the same window; experiments are those of monte_carlo/evaluation.h on the linear truth.

#include <cstdint>
#include <string>
#include <vector>

#include "tuner_design/monte_carlo/evaluation.h"

namespace ehm::tuner_design {

struct SimonGargOptions {
  int table = 4;  ///< 4 or 5: MAP; 6 or 7: Kalman filter
  double qh_percent2 = 1e-5;
  std::size_t engines = 100000;  ///< MAP
  std::size_t runs = 375;        ///< Kalman filter
  std::uint64_t seed = 1;
  unsigned threads = 1;
};

struct StudyRow {
  std::string group;   ///< what the tuners are
  std::string tuners;  ///< "a" to "h", or empty
  design::ErrorByChannel theory;
  design::ErrorByChannel experiment, standard_error;  ///< empty for a limit
};

struct SimonGargStudy {
  linear_model::LinearModel model;
  linear_model::Scaling scaling;
  SimonGargOptions options;
  std::string truth;  ///< one line: what the experiments fly on
  std::vector<StudyRow> rows;

  [[nodiscard]] bool of_health() const noexcept { return options.table == 4 || options.table == 6; }
};

/// @throws std::invalid_argument if the table is none of 4 to 7, the model has not more health parameters than sensors,
///         or, for 5 and 7, no auxiliary outputs.
/// @throws as design_tuner and evaluate.
SimonGargStudy run_simon_garg(
    const linear_model::LinearModel& model, const SimonGargOptions& options,
    const EvaluateProgress& progress = [](double) {});

}  // namespace ehm::tuner_design
