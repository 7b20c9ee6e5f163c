// SPDX-License-Identifier: Apache-2.0
#pragma once
// The certificate of a design for people: is it at an optimum, how near to the limit, do the starts agree.

#include <iosfwd>

#include "engine_sim/linear_model/linear_model.h"
#include "monitor/design/certificate.h"

namespace ehm::tuner_design {

/// How well a slow bias of each sensor can be told from deterioration (monitor/design/detectability.h); nothing where
/// it is not known.
void print_detectability(const linear_model::LinearModel& model, const Eigen::VectorXd& detectability,
                         std::ostream& out);

void print_certificate(const design::Certificate& certificate, std::ostream& out);

}  // namespace ehm::tuner_design
