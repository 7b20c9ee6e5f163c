// SPDX-License-Identifier: Apache-2.0
#pragma once
// The studies by name, each a line of one table: command line, help and report take them from it.

#include <span>
#include <string>
#include <vector>

#include "tuner_design/cli/engine_option.h"
#include "tuner_design/cli/import_options.h"
#include "tuner_design/cli/studies/endurthi_command.h"
#include "tuner_design/cli/studies/family_study_command.h"
#include "tuner_design/cli/studies/fault_study_command.h"
#include "tuner_design/cli/studies/flight_study_command.h"
#include "tuner_design/cli/studies/kosanam_command.h"
#include "tuner_design/cli/studies/lu_study_command.h"
#include "tuner_design/cli/studies/model_study_command.h"

namespace ehm::tuner_design {

/// What the command line says of all studies; of one study its own part counts.
struct StudyArguments {
  std::string study, model, trim = "new";
  ImportOptions import;
  SimonGargOptions options;  ///< its seed and threads are those of all studies
  FaultStudyArguments faults;
  FlightStudyArguments flight;
  RobustStudyOptions robust;
  KosanamArguments kosanam;
  LuOptions lu;
  FamilyOptions family;
  EndurthiArguments endurthi;
  EngineOption engine;

  StudyArguments();
  StudyGiven given() const { return {engine.engine(), options.seed, static_cast<unsigned>(options.threads)}; }
};

struct StudyKind {
  const char* name;
  const char* result;  ///< names with the same one share a result: of these a report runs the first
  bool has_csv;
  bool has_page;     ///< --html
  bool in_a_report;  ///< can be asked of `report --studies`
  bool of_a_design;  ///< needs --design
  StudyOutcome (*run)(const StudyArguments&, const StudyProgress&);
};

std::span<const StudyKind> study_kinds();
/// @throws std::out_of_range if there is none of that name
const StudyKind& study_kind(const std::string& name);
std::vector<std::string> study_names();
std::vector<std::string> report_study_names();

}  // namespace ehm::tuner_design
