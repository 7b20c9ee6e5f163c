// SPDX-License-Identifier: Apache-2.0
#pragma once
// From a design to the constants of its error propagation, for one sensor set.

#include "monitor/design/design.h"
#include "monitor/estimation/error_propagation.h"

namespace ehm::design {

/// `subset` is design.full or one of design.missing.
estimation::ErrorModel make_error_model(const Design& design, const SubsetDesign& subset);

}  // namespace ehm::design
