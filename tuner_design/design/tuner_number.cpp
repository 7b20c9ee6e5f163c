// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/design/tuner_number.h"

#include <algorithm>
#include <cmath>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"
#include "tuner_design/theory/observability.h"

namespace ehm::tuner_design {
namespace {

/// H Ph^1/2.
Eigen::MatrixXd fleet_signal(const PreparedPoint& point, const std::vector<int>& sensors) {
  return point.steady.H(sensors, Eigen::all) * point.model.health_sigma.asDiagonal();
}

Eigen::Index distinct(const Eigen::MatrixXd& G) {
  Eigen::MatrixXd rows = G.rowwise().normalized();
  for (Eigen::Index i = 0; i < rows.rows(); ++i)
    if (!(G.row(i).norm() > 0.0)) rows.row(i).setZero();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(rows.transpose());
  return (qr.matrixQR().diagonal().cwiseAbs().array() > distinct_share).count();
}

Eigen::Index heard(const Eigen::MatrixXd& whitened, const Eigen::VectorXd& health_sigma, double qh_percent2) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(whitened, Eigen::ComputeThinV);
  const Eigen::Index seen = seen_rank(svd.singularValues());
  Eigen::Index count = 0;
  for (; count < seen; ++count) {
    const double walk = std::sqrt(qh_percent2) * svd.matrixV().col(count).cwiseQuotient(health_sigma).norm();
    if (walk >= 2.0 * svd.singularValues()(count)) break;
  }
  return std::max<Eigen::Index>(count, seen > 0 ? 1 : 0);
}

}  // namespace

Eigen::Index most_tuners(const PreparedPoint& point, const std::vector<int>& sensors, double qh_percent2) {
  if (sensors.empty()) return 0;
  const Eigen::MatrixXd G = fleet_signal(point, sensors);
  const Eigen::VectorXd noise = point.model.sensor_noise_sigma(sensors);
  return std::min(distinct(G), heard(noise.cwiseInverse().asDiagonal() * G, point.model.health_sigma, qh_percent2));
}

std::vector<int> seeing_sensors(const std::vector<PreparedPoint>& points, const std::vector<int>& sensors) {
  if (sensors.empty()) return {};
  std::vector<bool> sees(sensors.size(), false);
  for (const PreparedPoint& point : points) {
    const Eigen::VectorXd signal =
        fleet_signal(point, sensors).rowwise().norm().cwiseQuotient(point.model.sensor_noise_sigma(sensors));
    const double least = Observability::relative_tolerance * signal.maxCoeff();
    for (std::size_t i = 0; i < sensors.size(); ++i) {
      const double own = signal(as_index(i));
      sees[i] = sees[i] || (own > 0.0 && own > least);
    }
  }
  std::vector<int> result;
  for (std::size_t i = 0; i < sensors.size(); ++i)
    if (sees[i]) result.push_back(sensors[i]);
  return result;
}

std::vector<std::string> blind_sensors(const linear_model::LinearModel& model, const std::vector<int>& seeing) {
  std::vector<std::string> names;
  for (const int i : all_sensors(model))
    if (!std::binary_search(seeing.begin(), seeing.end(), i)) names.push_back(model.sensors[as_size(i)].name);
  return names;
}

}  // namespace ehm::tuner_design
