// SPDX-License-Identifier: Apache-2.0
#pragma once
// The look of the report: light, dark, narrow and printed. Every colour is a variable; numbers 1 to 6 are those of
// chart_frame.h.

namespace ehm::tuner_design::report {

extern const char* const page_style;

}  // namespace ehm::tuner_design::report
