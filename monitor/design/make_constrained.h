// SPDX-License-Identifier: Apache-2.0
#pragma once
// A constrained estimator (estimation/constrained/constrained_estimator.h) as an operator's options have it, around one
// that has been made.
// @throws OptionError (key, value, allowed) if estimator.constraint is none of the ways, estimator.wear_raises
// names what is no health parameter of the design, truncation is to feed back, or the one inside has not what the way
// needs: a covariance of health, or where the constrained health is to feed back a state that can hold it.

#include <memory>

#include "monitor/data/options.h"
#include "monitor/design/design.h"
#include "monitor/estimation/constrained/constrained_estimator.h"

namespace ehm::design {

std::unique_ptr<estimation::Estimator> make_constrained_estimator(std::unique_ptr<estimation::Estimator> inner,
                                                                  const Design& design,
                                                                  const monitor::EstimatorOptions& options);

}  // namespace ehm::design
