// SPDX-License-Identifier: Apache-2.0
#pragma once
// The nonlinear filters of the papers on the engine that a design was made of (make_on_board.h), as estimators.
// What differs by its build or its instruments, they know nothing of.
// @throws std::invalid_argument as make_on_board.h.

#include <memory>

#include "monitor/data/options.h"
#include "monitor/design/design.h"
#include "monitor/estimation/estimator.h"
#include "monitor/nonlinear/nonlinear_filter.h"
#include "monitor/onboard/on_board_model.h"

namespace ehm::design {

enum class NonlinearKind { extended, iterated, clipped, unscented, particle, extended_particle, boxed_particle };

/// The filter itself, for a model without causes of mismatch.
std::unique_ptr<nonlinear::NonlinearFilter> make_nonlinear_filter(NonlinearKind kind,
                                                                  const onboard::OnBoardModel& model,
                                                                  const monitor::EstimatorOptions& options);

/// That filter on that model.
std::unique_ptr<estimation::Estimator> make_nonlinear_estimator(NonlinearKind kind,
                                                                std::shared_ptr<const onboard::OnBoardModel> model,
                                                                const monitor::EstimatorOptions& options);

/// The same, of a design's engine.
std::unique_ptr<estimation::Estimator> make_nonlinear_estimator(NonlinearKind kind, const Design& design,
                                                                const monitor::EstimatorOptions& options);

}  // namespace ehm::design
