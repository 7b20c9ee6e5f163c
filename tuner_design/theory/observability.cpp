// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/theory/observability.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"

namespace ehm::tuner_design {
namespace {

/// Channels that take part in the combination `direction`.
std::vector<std::string> named(const Eigen::VectorXd& direction, const std::vector<linear_model::Channel>& channels) {
  constexpr double takes_part = 0.1;
  std::vector<std::string> names;
  for (Eigen::Index i = 0; i < direction.size(); ++i) {
    if (std::abs(direction(i)) > takes_part) names.push_back(channels[as_size(i)].name);
  }
  return names;
}

}  // namespace

int seen_rank(const Eigen::VectorXd& singular_values) {
  const double least = Observability::relative_tolerance * singular_values.maxCoeff();
  return static_cast<int>(std::count_if(singular_values.begin(), singular_values.end(),
                                        [&](double value) { return value > 0.0 && value > least; }));
}

Observability steady_observability(const linear_model::LinearModel& model, const Eigen::MatrixXd& H) {
  // Hs = R^-1/2 H Ph^1/2
  const Eigen::MatrixXd Hs = model.sensor_noise_sigma.cwiseInverse().asDiagonal() * H * model.health_sigma.asDiagonal();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(Hs, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Observability result;
  result.singular_values = svd.singularValues();
  result.needed_rank = static_cast<int>(std::min(H.rows(), H.cols()));
  const double largest = result.singular_values(0);
  result.rank = seen_rank(result.singular_values);
  result.condition = result.rank > 0 ? largest / result.singular_values(result.rank - 1) : 0.0;
  if (!result.full_rank()) {
    const bool few_sensors = H.rows() < H.cols();
    result.culprits = few_sensors ? named(svd.matrixU().col(result.needed_rank - 1), model.sensors)
                                  : named(svd.matrixV().col(result.needed_rank - 1), model.health);
  }
  return result;
}

Eigen::VectorXd pair_singular_values(const Eigen::MatrixXd& A, const Eigen::MatrixXd& C,
                                     const Eigen::VectorXd& noise_sigma) {
  const Eigen::Index n = A.rows(), m = C.rows();
  Eigen::MatrixXd stacked(n * m, n);
  Eigen::MatrixXd block = noise_sigma.cwiseInverse().asDiagonal() * C;
  for (Eigen::Index k = 0; k < n; ++k) {
    stacked.middleRows(k * m, m) = block;
    block = (block * A).eval();
  }
  return Eigen::JacobiSVD<Eigen::MatrixXd>(stacked).singularValues();
}

std::string rank_note(const Observability& observability, bool fewer_sensors_than_health) {
  if (observability.full_rank() || observability.rank == 0) return "";
  std::string names;
  for (const std::string& name : observability.culprits) names += (names.empty() ? "" : ", ") + name;
  std::ostringstream note;
  if (fewer_sensors_than_health) {
    note << "sensors {" << names << "} repeat each other in the steady state";
  } else {
    note << "the sensors cannot tell health parameters {" << names << "} apart";
  }
  note << ": " << observability.rank << " combinations of health are seen, of " << observability.needed_rank;
  return note.str();
}

void require_observable(const Observability& observability) {
  if (observability.rank > 0) return;
  throw std::runtime_error(
      "no sensor sees anything of health in the steady state: H = C (I-A)^-1 L + M is zero. Check L, C and M");
}

}  // namespace ehm::tuner_design
