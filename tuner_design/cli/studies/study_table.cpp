// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/studies/study_table.h"

#include <algorithm>
#include <stdexcept>

#include "deploy/runtime/long_work/parallel_for.h"
#include "tuner_design/kosanam/mapss_model.h"

namespace ehm::tuner_design {
namespace {

using Arguments = const StudyArguments&;
using Progress = const StudyProgress&;

/// The model of --model, or the engine's at cruise.
ImportedModel model_of(Arguments a) {
  return a.model.empty() ? ImportedModel{cruise_model(a.engine.engine(), a.trim == "half-worn"), "", {}}
                         : import_model(a.model, a.import);
}

/// The model of --model, or MAPSS.
ImportedModel mapss_of(Arguments a) {
  return a.model.empty() ? ImportedModel{mapss_model(), "", {}} : import_model(a.model, a.import);
}

StudyOutcome simon_garg(Arguments a, Progress progress) {
  return simon_garg_study(a.study, a.options, model_of(a), a.model, progress);
}

StudyOutcome robust(Arguments a, Progress) {
  RobustStudyOptions options = a.robust;
  options.qh_percent2 = a.options.qh_percent2;
  return robust_study(options, model_of(a), a.model);
}

StudyOutcome family(Arguments a, Progress progress) {
  FamilyOptions options = a.family;
  options.estimator.engine = a.engine.name_or_file;
  options.engines = a.flight.fleet.value_or(options.engines);
  return family_study(a.faults.design, options, a.given(), progress);
}

StudyOutcome faults(Arguments a, Progress progress) {
  FaultStudyArguments arguments = a.faults;
  arguments.mission.engine_name = a.engine.name_or_file;
  return fault_study(arguments, a.given(), progress);
}

StudyOutcome false_alarms(Arguments a, Progress progress) {
  return false_alarm_study(a.faults, a.given(), progress);
}

StudyOutcome flight(Arguments a, Progress progress) {
  return whole_flight_study(a.flight, a.given(), progress);
}

StudyOutcome starts(Arguments a, Progress progress) {
  return start_study(a.flight, a.given(), progress);
}

StudyOutcome margin(Arguments a, Progress progress) {
  return margin_study(a.flight, a.given(), progress);
}

StudyOutcome points(Arguments a, Progress progress) {
  return point_study(a.flight, a.given(), progress);
}

StudyOutcome lu(Arguments a, Progress progress) {
  return lu_study(a.study, a.lu, a.given(), progress);
}

StudyOutcome kosanam_constrained(Arguments a, Progress progress) {
  return kosanam_constrained_study(a.kosanam, mapss_of(a), a.model, a.given(), progress);
}

StudyOutcome kosanam_robust(Arguments a, Progress) {
  return kosanam_robust_study(a.kosanam, mapss_of(a), a.model, a.given());
}

StudyOutcome kosanam_search(Arguments a, Progress) {
  return kosanam_search_study(a.kosanam, mapss_of(a), a.model, a.given());
}

StudyOutcome endurthi_linear(Arguments a, Progress progress) {
  return endurthi_linear_study(a.study, a.given(), progress);
}

StudyOutcome endurthi_health(Arguments a, Progress progress) {
  return endurthi_health_study(a.study, a.endurthi, a.given(), progress);
}

StudyOutcome endurthi_pendulum(Arguments a, Progress) {
  return endurthi_pendulum_study(a.given());
}

StudyOutcome endurthi_turbofan(Arguments a, Progress) {
  return endurthi_turbofan_study(a.endurthi, a.given());
}

// tables 4 to 7 of Simon & Garg stand in the report of a design already; what has no page is in no report either
constexpr StudyKind kinds[] = {
    // name, result, CSV, page, in a report, of a design
    {"simon-garg-4", "simon-garg-4", true, true, false, false, simon_garg},
    {"simon-garg-5", "simon-garg-5", true, true, false, false, simon_garg},
    {"simon-garg-6", "simon-garg-6", true, true, false, false, simon_garg},
    {"simon-garg-7", "simon-garg-7", true, true, false, false, simon_garg},
    {"faults", "faults", true, false, false, true, faults},
    {"false-alarms", "false-alarms", true, false, false, true, false_alarms},
    {"flight", "flight", false, false, false, false, flight},
    {"starts", "starts", false, false, false, false, starts},
    {"margin", "margin", false, false, false, false, margin},
    {"points", "points", false, false, false, false, points},
    {"robust", "robust", false, true, true, false, robust},
    {"family", "family", true, true, true, true, family},
    {"lu-4", "lu-4", true, true, true, false, lu},
    {"lu-5", "lu-5", true, true, true, false, lu},
    {"lu-6", "lu-6", true, true, true, false, lu},
    {"lu-7", "lu-7", true, true, true, false, lu},
    {"lu-8", "lu-8", true, true, true, false, lu},
    {"lu-9", "lu-9", true, true, true, false, lu},
    {"kosanam-5.1", "kosanam-5.1", true, true, true, false, kosanam_constrained},
    {"kosanam-5.2", "kosanam-5.2", true, true, true, false, kosanam_robust},
    {"kosanam-5.3", "kosanam-5.2", true, true, true, false, kosanam_robust},
    {"kosanam-ga", "kosanam-ga", true, true, true, false, kosanam_search},
    {"endurthi-1", "endurthi-1", true, true, true, false, endurthi_linear},
    {"endurthi-2", "endurthi-1", true, true, true, false, endurthi_linear},
    {"endurthi-3", "endurthi-1", true, true, true, false, endurthi_linear},
    {"endurthi-4", "endurthi-4", true, true, true, false, endurthi_health},
    {"endurthi-5", "endurthi-4", true, true, true, false, endurthi_health},
    {"endurthi-ukf-pendulum", "endurthi-ukf-pendulum", false, true, true, false, endurthi_pendulum},
    {"endurthi-ukf-turbofan", "endurthi-ukf-turbofan", false, true, true, false, endurthi_turbofan},
};

}  // namespace

StudyArguments::StudyArguments() {
  options.threads = long_work::all_cores();
}

std::span<const StudyKind> study_kinds() {
  return kinds;
}

const StudyKind& study_kind(const std::string& name) {
  const auto* kind = std::find_if(std::begin(kinds), std::end(kinds), [&](const auto& k) { return name == k.name; });
  if (kind == std::end(kinds)) throw std::out_of_range("no study " + name);
  return *kind;
}

std::vector<std::string> study_names() {
  std::vector<std::string> names;
  for (const StudyKind& kind : kinds) names.emplace_back(kind.name);
  return names;
}

std::vector<std::string> report_study_names() {
  std::vector<std::string> names;
  for (const StudyKind& kind : kinds)
    if (kind.in_a_report) names.emplace_back(kind.name);
  return names;
}

}  // namespace ehm::tuner_design
