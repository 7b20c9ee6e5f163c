// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the sensors see of health in the steady state. In units of noise and of the fleet's spread,
//   Hs = R^-1/2 H Ph^1/2     m x p,
// a singular value s is the signal-to-noise ratio of one sample for one combination of health parameters. The augmented
// pair (Axq, Cxq) is detectable if and only if H W has full column rank, since A is stable and the tuners are
// integrators (Popov-Belevitch-Hautus test at eigenvalue 1); so a design has at most rank Hs tuners (tuner_number.h).
// Less than min(m, p) is no fault: probes of one quantity repeat each other, or health parameters look alike.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine_sim/linear_model/linear_model.h"

namespace ehm::tuner_design {

struct Observability {
  Eigen::VectorXd singular_values;    ///< min(m, p) values of Hs, descending
  int needed_rank = 0;                ///< min(m, p)
  int rank = 0;                       ///< singular values above `relative_tolerance` of the largest
  double condition = 0.0;             ///< largest over the least singular value that counts
  std::vector<std::string> culprits;  ///< sensors (m < p) or health parameters that cannot be told apart, if deficient

  static constexpr double relative_tolerance = 1e-6;
  [[nodiscard]] bool full_rank() const noexcept { return rank == needed_rank; }
};

/// Number of singular values that count: above zero and `relative_tolerance` of the largest.
int seen_rank(const Eigen::VectorXd& singular_values);

/// `model` is scaled, H its steady gain, both with the rows of the same sensors.
Observability steady_observability(const linear_model::LinearModel& model, const Eigen::MatrixXd& H);

/// Singular values, descending, of the noise-scaled observability matrix [C; C A; ... C A^(n-1)] of a pair.
Eigen::VectorXd pair_singular_values(const Eigen::MatrixXd& A, const Eigen::MatrixXd& C,
                                     const Eigen::VectorXd& noise_sigma);

/// Which channels repeat each other and how many combinations of health are seen; empty at full rank.
std::string rank_note(const Observability& observability, bool fewer_sensors_than_health);

/// @throws std::runtime_error if no sensor sees anything of health in the steady state.
void require_observable(const Observability& observability);

}  // namespace ehm::tuner_design
