// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tuner matrices that a design is compared with ([SG] sections "subset" and "SVD"). The bench ranks them by the error
// of kalman_error.h; all are in scaled units.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine_sim/linear_model/linear_model.h"

namespace ehm::tuner_design {

/// Tuners are chosen health parameters themselves: rows of the identity, t x p.
/// @throws std::invalid_argument if a name is unknown.
Eigen::MatrixXd subset_tuners(const linear_model::LinearModel& model, const std::vector<std::string>& names);

/// The model's own names of the subset of [SG] table 3, all but fan efficiency, LPC flow and LPT efficiency: "FAN_flow"
/// and "fan_flow", "HPT_eff" and "hpt_efficiency" are the same. Empty if the model lacks one.
std::vector<std::string> published_subset(const linear_model::LinearModel& model);

/// First t right singular vectors of [H; Hz] as rows, t x p.
/// @throws std::invalid_argument if t is not within 1 and p.
Eigen::MatrixXd svd_tuners(const Eigen::MatrixXd& H, const Eigen::MatrixXd& Hz, Eigen::Index t);

}  // namespace ehm::tuner_design
