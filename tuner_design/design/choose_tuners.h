// SPDX-License-Identifier: Apache-2.0
#pragma once
// The tuners V* of one sensor set, for one operating point or for an envelope of several.
//   closed form   V = T H Ph, T such that V has orthonormal rows: the bias of the filter is least when range(W) =
//                 range(Ph H^T), for health and every linear auxiliary output at once (theory.md, section 5). It is the
//                 best there is where the filter averages endlessly and one point is all; else it is the first start of
//                 the search.
//   the search    tuner_search.h: finite response time, several points, weights, linearisation error
// With as many tuners as health parameters nothing has to be chosen: V = I.

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "monitor/design/design.h"
#include "tuner_design/search/tuner_search.h"
#include "tuner_design/theory/prepared_point.h"

namespace ehm::tuner_design {

/// N of the closed form, |S| x |S|: the sensors' part of the linearisation error and the noise after some 4 s of
/// samples; R where the former is unknown.
Eigen::MatrixXd lasting_noise(const linear_model::LinearModel& model, const std::vector<int>& sensors);

/// Closed form for the sensors with steady gain H (|S| x p), t x p with orthonormal rows: V = I for t = p, else the row
/// space of U_t^T N^-1/2 H Ph with U_t the t strongest left singular vectors of N^-1/2 H Ph^1/2, which for t = |S| is
/// that of H Ph. `noise` is N, |S| x |S|, what a long average of these sensors still gets wrong.
/// @throws std::invalid_argument if t is not within 1 and min(|S|, p).
/// @throws std::runtime_error if N is not positive definite.
Eigen::MatrixXd closed_form_tuners(const Eigen::MatrixXd& H, const Eigen::MatrixXd& noise,
                                   const Eigen::VectorXd& health_sigma, Eigen::Index t);

/// Points of one design problem: models with the same channels, and their weights in the objective.
struct Envelope {
  std::vector<PreparedPoint> points;
  std::vector<double> weights;  ///< one for each point, above zero
};

struct ChosenTuners {
  SearchProblem problem;
  SearchResult search;                ///< its V is the choice
  std::optional<double> closed_form;  ///< J of the first start; none where that was chosen without a search
};

/// `random_starts` stands in place of options.random_starts: the designs for a missing sensor need fewer.
/// @throws as closed_form_tuners, make_point_problem and search_tuners.
ChosenTuners choose_tuners(
    const Envelope& envelope, const std::vector<int>& sensors, Eigen::Index t, const design::DesignOptions& options,
    int random_starts, unsigned threads, const std::function<void(double)>& progress = [](double) {});

}  // namespace ehm::tuner_design
