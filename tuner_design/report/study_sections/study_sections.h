// SPDX-License-Identifier: Apache-2.0
#pragma once
// The studies as sections of a page: tables with the published numbers beside ours, and the papers' figures by their
// numbers. Each is a function of the study's result alone, the one that its text is printed from. The ids of a section
// begin with the study's name, so that any of them share a page. Errors: none.

#include <vector>

#include "tuner_design/report/page/page.h"

namespace ehm::tuner_design {

struct ConstrainedTables;
struct FamilyStudy;
struct GainSearch;
struct LuStudy;
struct RobustStudy;
struct RobustTables;
struct SimonGargStudy;

namespace endurthi {
struct HealthStudy;
struct LinearisationStudy;
struct PendulumFilter;
struct TurbofanPoint;
}  // namespace endurthi

namespace report {

/// Every estimator in every case: one matrix, coverage and answer to a step.
Section family_section(const FamilyStudy& study);
/// Tables 4 to 7 of Simon & Garg.
Section simon_garg_section(const SimonGargStudy& study);
/// What a robust gain buys on a model, common and by sensor.
Section robust_section(const RobustStudy& study);

/// Tables 4 to 9 and figures 3 to 9 of Lu, Huang & Lv.
Section lu_section(const LuStudy& study);

/// Kosanam: table 5.1, figures 5.1 to 5.3.
Section constrained_section(const ConstrainedTables& tables);
/// Kosanam: tables 5.2 and 5.3, figures 5.4 to 5.6.
Section robust_tables_section(const RobustTables& tables);
/// Kosanam, chapter VI.
Section gain_search_section(const GainSearch& search);

/// Endurthi: tables I to III, figures 5.1 and 5.2.
Section linearisation_section(const endurthi::LinearisationStudy& study);
/// Endurthi: tables IV and V, figures 5.3 to 5.5.
Section health_section(const endurthi::HealthStudy& study);
Section pendulum_section(const std::vector<endurthi::PendulumFilter>& study);
Section turbofan_section(const std::vector<endurthi::TurbofanPoint>& study);

}  // namespace report
}  // namespace ehm::tuner_design
