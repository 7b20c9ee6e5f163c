// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a report computes beside the design: the baselines, the search once more for its course, the trade of response
// time against accuracy, and the Monte Carlo. The same design gives the same studies on any number of threads.

#include <functional>
#include <string>
#include <vector>

#include "monitor/design/design.h"
#include "tuner_design/baselines/baselines.h"
#include "tuner_design/design/response_time.h"
#include "tuner_design/monte_carlo/evaluation.h"
#include "tuner_design/studies/simon_garg.h"

namespace ehm::tuner_design::report {

/// The course of one start of the search: best J after each evaluation.
struct SearchCourse {
  std::string start;
  std::vector<double> objective;
};

struct Studies {
  std::vector<Baseline> baselines;
  std::vector<SearchCourse> courses;  ///< empty for a design without a search, and for an envelope of several points
  std::vector<ResponsePoint> trade;   ///< over Qh, ascending
  std::vector<Experiment> experiments;
  std::vector<SimonGargStudy> papers;  ///< tables 4 to 7, for a model with the ten health parameters of [SG]
  std::vector<std::string> not_flown;  ///< in sentences: which experiments are missing, and why
};

struct StudyOptions {
  bool quick = false;  ///< no Monte Carlo, and none of the papers' tables
  std::shared_ptr<const engine_sim::EngineDefinition> engine =
      engine_sim::default_engine();  ///< of the nonlinear truth
  unsigned threads = 1;
  std::function<void(double)> progress = [](double) {};  ///< share of the work that is done, 0 to 1
};

/// @throws as design_tuner.
Studies run_studies(const design::Design& design, const StudyOptions& options);

}  // namespace ehm::tuner_design::report
