// SPDX-License-Identifier: Apache-2.0
#pragma once
// The estimator on a design's schedule. @throws std::invalid_argument if the design has none.

#include <memory>

#include "monitor/data/options.h"
#include "monitor/design/design.h"
#include "monitor/estimation/estimator.h"

namespace ehm::design {

std::unique_ptr<estimation::Estimator> make_scheduled_estimator(const Design& design,
                                                                const monitor::EstimatorOptions& options);

}  // namespace ehm::design
