// SPDX-License-Identifier: Apache-2.0
#pragma once
// What is known of how good the tuners of a design are, written beside them. The objective is
//   J = w_h SSEE(h)/limit(h) + w_z SSEE(z)/limit(z),     SSEE(z) and limit(z) with the channels' weights,
// averaged over the points of an envelope with their weights; at the Bayes limits J = w_h + w_z. A tuner matrix is
// known by its row space only; row spaces are compared by their largest principal angle.

#include <Eigen/Core>
#include <string>
#include <vector>

namespace ehm::design {

/// One start of the search and where it ended.
struct SearchStart {
  std::string name;            ///< "closed form H Ph", "SVD of [H; Hz]", "random 3"
  double first = 0.0;          ///< J at the start
  double last = 0.0;           ///< J at the end
  double gradient_norm = 0.0;  ///< |dJ/dV| at the end
  double angle_rad = 0.0;      ///< largest principal angle between its end and the design's row space
  int evaluations = 0;
};

/// One operating point of an envelope.
struct CertifiedPoint {
  std::string model;
  double weight = 1.0;
  double health_ratio = 0.0, auxiliary_ratio = 0.0;  ///< weighted SSEE over limit
};

struct Certificate {
  double objective = 0.0;              ///< J
  double closed_form_objective = 0.0;  ///< J of V = H Ph at the first point
  double lower_bound = 0.0;            ///< J of the Bayes limits
  bool limit_is_prior = false;         ///< limit(z) vanishes and the fleet's own spread stands in its place
  double gradient_norm = 0.0;          ///< |dJ/dV|
  double possible_gain = 0.0;          ///< of J by a Newton step from here: g^T Hessian^+ g / 2
  double least_curvature = 0.0, largest_curvature = 0.0;  ///< eigenvalues of the Hessian on the row spaces
  int flat_directions = 0;                                ///< of the row space that J does not notice
  bool at_optimum = false;
  std::string verdict;  ///< one sentence: what it is, or why it is none
  std::vector<SearchStart> starts;
  std::vector<CertifiedPoint> points;
  Eigen::VectorXd steady_singular_values;   ///< of R^-1/2 H Ph^1/2
  Eigen::VectorXd pair_singular_values;     ///< of the observability matrix of (Axq, Cxq), noise-scaled
  double condition = 0.0;                   ///< of R^-1/2 H Ph^1/2
  Eigen::VectorXd slow_bias_detectability;  ///< by sensor (detectability.h); empty in a file that does not tell it
};

}  // namespace ehm::design
