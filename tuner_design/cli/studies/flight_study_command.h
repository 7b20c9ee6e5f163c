// SPDX-License-Identifier: Apache-2.0
#pragma once
// The studies of whole flights, whose truths differ from the on-board model:
//   flight   is health estimated in every sample, and honestly?
//   starts   does every engine of a fleet start its mission?
//   margin   is the EGT margin known over an engine's life?
// and beside them
//   points   the tuner filter at single points from approach to take-off

#include <optional>
#include <string>

#include "tuner_design/cli/command.h"
#include "tuner_design/cli/studies/study_outcome.h"
#include "tuner_design/flight/flight_figures.h"
#include "tuner_design/flight/margin_study.h"
#include "tuner_design/flight/start_study.h"
#include "tuner_design/points/point_study.h"

namespace ehm::tuner_design {

struct FlightStudyArguments {
  std::optional<std::size_t> fleet;
  FlightStudyOptions flight;
  std::string schedule;  ///< design file of estimator scheduled; empty: it is not flown
  StartStudyOptions starts;
  MarginStudyOptions margin;
  PointStudyOptions points;
};

/// --fleet, --step, --starts; engine, seed and threads are the study command's.
void add_flight_study_options(CLI::App& command, FlightStudyArguments& arguments);

/// @throws files::FileError if the design of --schedule is bad
StudyOutcome whole_flight_study(const FlightStudyArguments& arguments, const StudyGiven& given,
                                const StudyProgress& progress);
StudyOutcome start_study(const FlightStudyArguments& arguments, const StudyGiven& given, const StudyProgress& progress);
StudyOutcome margin_study(const FlightStudyArguments& arguments, const StudyGiven& given,
                          const StudyProgress& progress);
StudyOutcome point_study(const FlightStudyArguments& arguments, const StudyGiven& given, const StudyProgress& progress);

}  // namespace ehm::tuner_design
