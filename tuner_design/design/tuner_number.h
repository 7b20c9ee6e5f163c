// SPDX-License-Identifier: Apache-2.0
#pragma once
// How many tuners a set of sensors gives: as many as combinations of health that it can teach. Rank decides, not the
// number of sensors. With G = H Ph^1/2 (m x p), what each sensor shows of the fleet, two limits, both of physics:
//
//   distinct  a probe counts as new if more than 5 % of its row of G lies outside the span of those that came before
//             it (the largest remainder first; a QR factorisation with pivots of the rows scaled to length one). No
//             linear model knows its sensitivities better than that; a smaller difference of two probes is the model's
//             error. Taken as information it is amplified by its inverse, and makes the filter slow.
//   heard     a combination with the singular value s of R^-1/2 G counts if the filter learns more of it than the fleet
//             tells: one whose unit variance walks by w^2 a sample (Qh seen by its right singular vector v,
//             w^2 = qh |Ph^-1/2 v|^2) is estimated with the variance w / (2 s), which is to be below 1.
//
// t is the smaller of the two, at least 1 if anything is seen; the tuners are then the t strongest combinations
// (closed_form_tuners), in which equal probes are averaged by their noise. A sensor whose row of G, in units of its
// noise, vanishes beside the others' sees nothing, and no design uses it.
// Source: own; Golub & Van Loan, Matrix Computations, section 5.5 (rank-revealing QR). Errors: none.

#include <string>
#include <vector>

#include "tuner_design/theory/prepared_point.h"

namespace ehm::tuner_design {

inline constexpr double distinct_share = 0.05;

/// Most tuners for these sensors of the point; 0 if they see nothing.
Eigen::Index most_tuners(const PreparedPoint& point, const std::vector<int>& sensors, double qh_percent2);

/// Of `sensors` those that see something of health in the steady state at one of the points.
std::vector<int> seeing_sensors(const std::vector<PreparedPoint>& points, const std::vector<int>& sensors);

/// Names of the others. `seeing` ascending.
std::vector<std::string> blind_sensors(const linear_model::LinearModel& model, const std::vector<int>& seeing);

}  // namespace ehm::tuner_design
