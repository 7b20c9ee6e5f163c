// SPDX-License-Identifier: Apache-2.0
#include "monitor/estimation/snapshot/snapshot_gain.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <array>

#include "deploy/runtime/numbers/index.h"

namespace ehm::estimation {
namespace {

constexpr double least_signal = 1e-6;  ///< of the strongest; less is not told apart from nothing

using SensorMatrix = BoundedMatrix<max_sensors, max_sensors>;

/// The sensors of a mask, ascending.
class Chosen {
 public:
  Chosen(SensorMask sensors, Eigen::Index of) noexcept {
    for (Eigen::Index i = 0; i < of; ++i)
      if (sensors[as_size(i)]) index_[as_size(count_++)] = i;
  }
  Eigen::Index count() const noexcept { return count_; }

  /// Their rows of a matrix.
  template <int MaxCols>
  BoundedMatrix<max_sensors, MaxCols> rows(const BoundedMatrix<max_sensors, MaxCols>& all) const noexcept {
    BoundedMatrix<max_sensors, MaxCols> some(count_, all.cols());
    for (Eigen::Index i = 0; i < count_; ++i) some.row(i) = all.row(index_[as_size(i)]);
    return some;
  }
  /// The gain of all sensors, of the transposed one of these.
  SnapshotGain spread(const BoundedMatrix<max_sensors, max_health>& transposed, Eigen::Index of) const noexcept {
    SnapshotGain gain = SnapshotGain::Zero(transposed.cols(), of);
    for (Eigen::Index i = 0; i < count_; ++i) gain.col(index_[as_size(i)]) = transposed.row(i);
    return gain;
  }

 private:
  std::array<Eigen::Index, max_sensors> index_{};
  Eigen::Index count_ = 0;
};

}  // namespace

SnapshotGain map_gain(const SnapshotModel& model, SensorMask sensors) noexcept {
  const Chosen chosen(sensors, model.sensors());
  const auto health = chosen.rows(model.health_signal);
  const auto offset = chosen.rows(model.offset_signal);
  const auto state = chosen.rows(model.state_signal);
  SensorMatrix readings = SensorMatrix::Identity(chosen.count(), chosen.count());  // their covariance
  readings += health.lazyProduct(health.transpose());
  readings += offset.lazyProduct(offset.transpose());
  const BoundedMatrix<max_sensors, max_states> moved = state.lazyProduct(model.motion);
  readings += moved.lazyProduct(state.transpose());
  return chosen.spread(readings.llt().solve(health), model.sensors());
}

SnapshotGain least_squares_gain(const SnapshotModel& model, SensorMask sensors) noexcept {
  const Chosen chosen(sensors, model.sensors());
  const auto health = chosen.rows(model.health_signal);
  if (chosen.count() == 0) return SnapshotGain::Zero(model.health(), model.sensors());
  // Hn^+ = Hn^T (Hn Hn^T)^+, and the pseudoinverse of a symmetric matrix by its eigenvalues
  const SensorMatrix gram = health.lazyProduct(health.transpose());
  const Eigen::SelfAdjointEigenSolver<SensorMatrix> spectrum(gram);
  const double least = least_signal * least_signal * spectrum.eigenvalues()(chosen.count() - 1);
  BoundedMatrix<max_sensors, max_health> transposed =
      BoundedMatrix<max_sensors, max_health>::Zero(chosen.count(), model.health());
  for (Eigen::Index i = 0; i < chosen.count(); ++i) {
    const double square = spectrum.eigenvalues()(i);
    if (!(square > least)) continue;
    const SensorVector u = spectrum.eigenvectors().col(i);
    const HealthVector signal = health.transpose().lazyProduct(u);
    transposed += u.lazyProduct(signal.transpose()) / square;
  }
  return chosen.spread(transposed, model.sensors());
}

}  // namespace ehm::estimation
