// SPDX-License-Identifier: Apache-2.0
#pragma once
// The whole report of a design as a page.

#include "monitor/design/design.h"
#include "tuner_design/report/page/page.h"
#include "tuner_design/report/studies.h"

namespace ehm::tuner_design::report {

/// @throws std::runtime_error if a steady state of the model or of the filter cannot be computed.
Page design_page(const design::Design& design, const Studies& studies);

}  // namespace ehm::tuner_design::report
