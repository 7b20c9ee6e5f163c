#pragma once
// What the sensors see of health in the steady state. In units of noise and of the fleet's spread,
//   Hs = R^-1/2 H Ph^1/2     m x p,
// a singular value s is the signal-to-noise ratio of one sample for one combination of health parameters. The augmented
// pair (Axq, Cxq) is detectable if and only if H W has full column rank, since A is stable and the tuners are
// integrators (Popov-Belevitch-Hautus test at eigenvalue 1); so rank min(m, p) of Hs is what a design needs.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "monitor/estimation/linear_model.h"

namespace ehm::bench {

struct Observability {
  Eigen::VectorXd singular_values;    ///< min(m, p) values of Hs, descending
  int needed_rank = 0;                ///< min(m, p)
  int rank = 0;                       ///< singular values above `relative_tolerance` of the largest
  double condition = 0.0;             ///< of Hs; that of H Ph H^T (in noise units) is its square
  std::vector<std::string> culprits;  ///< sensors (m < p) or health parameters that cannot be told apart, if deficient

  static constexpr double relative_tolerance = 1e-6;
  [[nodiscard]] bool sufficient() const noexcept { return rank == needed_rank; }
};

/// Number of singular values that count: above zero and `relative_tolerance` of the largest.
int seen_rank(const Eigen::VectorXd& singular_values);

/// `model` is scaled, H its steady gain, both with the rows of the same sensors.
Observability steady_observability(const estimation::LinearModel& model, const Eigen::MatrixXd& H);

/// Singular values, descending, of the noise-scaled observability matrix [C; C A; ... C A^(n-1)] of a pair.
Eigen::VectorXd pair_singular_values(const Eigen::MatrixXd& A, const Eigen::MatrixXd& C,
                                     const Eigen::VectorXd& noise_sigma);

/// @throws std::runtime_error if the rank does not suffice: says which channels, the singular values, what to do.
void require_observable(const Observability& observability, bool fewer_sensors_than_health);

}  // namespace ehm::bench
