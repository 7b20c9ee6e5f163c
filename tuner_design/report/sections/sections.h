// SPDX-License-Identifier: Apache-2.0
#pragma once
// The sections of a report, in its order. Each is a function of the data alone.

#include "tuner_design/report/page/page.h"
#include "tuner_design/report/report_data.h"

namespace ehm::tuner_design::report {

/// In words: what was designed, how near to the limit, whether it is at an optimum.
Section summary_section(const ReportData& data);
/// What was designed and from what: model, operating point, options, channels with units, trims, spreads, scales.
Section origin_section(const ReportData& data);
/// Total errors against the limits and other estimators; sigma by channel with its parts.
Section accuracy_section(const ReportData& data);
/// The certificate of the tuners and the course of their search.
Section optimum_section(const ReportData& data);
/// Which combinations of health parameters the sensors see.
Section observability_section(const ReportData& data);
/// V* in physical names, and what remains of a health parameter in the estimate.
Section tuner_section(const ReportData& data);
/// How the filter answers a step, and what speed costs.
Section response_section(const ReportData& data);
/// What the Monte Carlo found, or why there is none.
Section evaluation_section(const ReportData& data);
/// Tables 4 to 7 of Simon & Garg on this engine, for a model with their health parameters.
Section papers_section(const ReportData& data);
/// The designs for the case that a sensor fails.
Section missing_sensor_section(const ReportData& data);

}  // namespace ehm::tuner_design::report
