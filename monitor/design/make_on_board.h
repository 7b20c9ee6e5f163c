// SPDX-License-Identifier: Apache-2.0
#pragma once
// The on-board estimator of a design: the engine that the design was made of, or the one that the options name, with
// the channels of the design.
// @throws std::invalid_argument if neither names an engine, there is none of that name, its channels are not the
// design's in their order, or it has one that the on-board model has no slopes of.

#include <memory>
#include <string>
#include <vector>

#include "monitor/data/options.h"
#include "monitor/design/design.h"
#include "monitor/estimation/estimator.h"
#include "monitor/onboard/on_board_model.h"

namespace ehm::design {

std::shared_ptr<const onboard::OnBoardModel> make_on_board_model(const Design& design,
                                                                 const monitor::EstimatorOptions& options);

/// What Learned holds of it, in order: the health parameters, then the causes of mismatch.
std::vector<std::string> learned_names(const onboard::OnBoardModel& model);

std::unique_ptr<estimation::Estimator> make_on_board_estimator(const Design& design,
                                                               const monitor::EstimatorOptions& options);

}  // namespace ehm::design
