// SPDX-License-Identifier: Apache-2.0
#pragma once
// An evaluation as tables for people, one JSON object for scripts, and CSV for figures: all with the same numbers.
// Errors are squared: health in percent^2, auxiliary outputs in the reporting unit squared. "off by" is
// (experiment - theory - linearisation)/standard error.

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>

#include "tuner_design/monte_carlo/evaluation.h"

namespace ehm::tuner_design {

/// Keys: name, hash, runs, engines, seconds, window_s, seed, process_noise, wear, auxiliary_unit, experiments: an array
/// of {estimator, truth, nonlinear, engines, without_steady_point, health, auxiliary}, the last two {total, by_channel}
/// of {theory, linearisation, settled, experiment, standard_error, off_by, coverage, coverage_standard_error}; the
/// total has no coverage, nor has MAP.
nlohmann::ordered_json evaluation_as_json(const Evaluation& evaluation, const design::Design& design,
                                          const EvaluateOptions& options);

void print_evaluation(const Evaluation& evaluation, const design::Design& design, const EvaluateOptions& options,
                      std::ostream& out);

/// One row a channel and experiment, and one for each total: estimator, truth, channel, unit and the numbers above.
std::string evaluation_as_csv(const Evaluation& evaluation, const design::Design& design);

}  // namespace ehm::tuner_design
