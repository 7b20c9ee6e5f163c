// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/sensors/subset_bounds.h"

#include <algorithm>

#include "tuner_design/theory/observability.h"

namespace ehm::tuner_design {
namespace {

class Walk {
 public:
  Walk(const SensorProblem& problem, std::vector<double>& bounds)
      : G_(problem.model.health_sigma.asDiagonal() * problem.steady.H.transpose()),
        root_(problem.model.health_sigma),
        outputs_(problem.steady.Hz * problem.model.health_sigma.asDiagonal()),
        merit_(problem.merit),
        Q_(G_.rows(), std::min(G_.rows(), G_.cols())),
        bounds_(bounds) {
    add_sensors(0, 0, 0, fleet_merit(problem));
  }

 private:
  /// Every set that adds to `set` sensors from `first` on; `rank` columns of Q are in use.
  void add_sensors(CandidateSet set, Eigen::Index first, Eigen::Index rank, double bound) {
    bounds_[set] = bound;
    for (Eigen::Index i = first; i < G_.cols(); ++i) {
      const CandidateSet larger = set | CandidateSet{1} << static_cast<unsigned>(i);
      const Eigen::VectorXd direction = new_direction(G_.col(i), rank);
      if (direction.size() == 0) {
        add_sensors(larger, i + 1, rank, bound);
        continue;
      }
      Q_.col(rank) = direction;
      const design::ErrorByChannel known{root_.cwiseProduct(direction).cwiseAbs2(), (outputs_ * direction).cwiseAbs2()};
      add_sensors(larger, i + 1, rank + 1, std::max(0.0, bound - merit_(known)));
    }
  }

  /// What g adds to the first `rank` columns of Q, of unit length; empty if nothing.
  Eigen::VectorXd new_direction(const Eigen::VectorXd& g, Eigen::Index rank) const {
    if (rank == Q_.cols()) return {};
    const auto Q = Q_.leftCols(rank);
    Eigen::VectorXd rest = g;
    for (int pass = 0; pass < 2; ++pass) rest -= Q * (Q.transpose() * rest).eval();  // twice is enough
    const double length = rest.norm();
    if (!(length > Observability::relative_tolerance * g.norm())) return {};
    return rest / length;
  }

  const Eigen::MatrixXd G_;        ///< Ph^1/2 H^T, p x n
  const Eigen::VectorXd root_;     ///< diagonal of Ph^1/2
  const Eigen::MatrixXd outputs_;  ///< Hz Ph^1/2
  const RelativeError& merit_;
  Eigen::MatrixXd Q_;  ///< p x min(p, n)
  std::vector<double>& bounds_;
};

}  // namespace

std::vector<double> subset_bounds(const SensorProblem& problem) {
  std::vector<double> bounds(std::size_t{problem.every()} + 1);
  Walk(problem, bounds);
  return bounds;
}

}  // namespace ehm::tuner_design
