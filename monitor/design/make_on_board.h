// SPDX-License-Identifier: Apache-2.0
#pragma once
// The on-board estimator of a design: the engine that the design was made of, or the one that the options name, with
// the channels of the design.
// @throws std::invalid_argument if neither names an engine, there is none of that name, its channels are not the
// design's in their order, or it has one that the on-board model has no slopes of.

#include <memory>

#include "monitor/data/options.h"
#include "monitor/design/design.h"
#include "monitor/estimation/estimator.h"

namespace ehm::design {

std::unique_ptr<estimation::Estimator> make_on_board_estimator(const Design& design,
                                                               const monitor::EstimatorOptions& options);

}  // namespace ehm::design
