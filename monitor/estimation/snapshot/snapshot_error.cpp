// SPDX-License-Identifier: Apache-2.0
#include "monitor/estimation/snapshot/snapshot_error.h"

namespace ehm::estimation {
namespace {

/// Of a linear function Th of health beside truth it does not know: Th Bh, Th Bo - offset, and the noise of
/// Th eps - state dx.
template <int Max>
VarianceParts<Max> variance_of(const SnapshotModel& model, const SnapshotError& error,
                               const BoundedMatrix<Max, max_health>& health,
                               const BoundedMatrix<Max, max_offsets>& offset,
                               const BoundedMatrix<Max, max_states>& state) noexcept {
  VarianceParts<Max> parts;
  const BoundedMatrix<Max, max_health> prior = health.lazyProduct(error.health_bias);
  BoundedMatrix<Max, max_offsets> nonlinear = health.lazyProduct(error.offset_bias);
  nonlinear -= offset;
  const BoundedMatrix<Max, max_health> own = health.lazyProduct(error.noise);
  const BoundedMatrix<Max, max_states> moved = state.lazyProduct(model.motion);
  const BoundedMatrix<Max, max_health> cross = state.lazyProduct(error.motion_cross);
  parts.prior = prior.rowwise().squaredNorm();
  parts.nonlinear = nonlinear.rowwise().squaredNorm();
  parts.noise = own.cwiseProduct(health).rowwise().sum();
  parts.noise += moved.cwiseProduct(state).rowwise().sum();
  parts.noise -= 2.0 * cross.cwiseProduct(health).rowwise().sum();
  return parts;
}

}  // namespace

SnapshotError nothing_seen(const SnapshotModel& model) noexcept {
  const Eigen::Index p = model.health(), n = model.states();
  SnapshotError error;
  error.health_bias = -HealthCovariance::Identity(p, p);
  error.offset_bias.setZero(p, model.offsets());
  error.motion_cross.setZero(n, p);
  error.noise.setZero(p, p);
  return error;
}

SnapshotError error_of(const SnapshotModel& model, const SnapshotGain& gain) noexcept {
  SnapshotError error = nothing_seen(model);
  error.health_bias += gain.lazyProduct(model.health_signal);
  error.offset_bias = gain.lazyProduct(model.offset_signal);
  const BoundedMatrix<max_health, max_states> state = gain.lazyProduct(model.state_signal);
  error.motion_cross = model.motion.lazyProduct(state.transpose());
  error.noise = gain.lazyProduct(gain.transpose());
  const HealthCovariance moved = state.lazyProduct(error.motion_cross);
  error.noise += 0.5 * (moved + moved.transpose());
  return error;
}

void move_on(const SnapshotModel& model, SnapshotError& error) noexcept {
  const BoundedMatrix<max_states, max_health> moved = model.A.lazyProduct(error.motion_cross);
  error.motion_cross = moved;
}

VarianceParts<max_health> health_variance(const SnapshotError& error) noexcept {
  return {error.health_bias.rowwise().squaredNorm(), error.offset_bias.rowwise().squaredNorm(), error.noise.diagonal()};
}

VarianceParts<max_auxiliary> auxiliary_variance(const SnapshotModel& model, const SnapshotError& error) noexcept {
  return variance_of<max_auxiliary>(model, error, model.health_output, model.offset_output, model.state_output);
}

VarianceParts<max_sensors> innovation_variance(const SnapshotModel& model, const SnapshotError& error) noexcept {
  auto parts = variance_of<max_sensors>(model, error, model.health_signal, model.offset_signal, model.state_signal);
  parts.noise.array() += 1.0;
  return parts;
}

HealthCovariance health_covariance(const SnapshotError& error, double excess) noexcept {
  HealthCovariance covariance = excess * error.health_bias.lazyProduct(error.health_bias.transpose());
  covariance += excess * excess * error.offset_bias.lazyProduct(error.offset_bias.transpose());
  covariance += error.noise;
  return covariance;
}

void save(const SnapshotModel& model, const SnapshotError& error, ErrorState& state) noexcept {
  const Eigen::Index n = model.states(), p = model.health(), l = model.offsets();
  state.mean.setZero(n + p, p + l);
  state.mean.bottomLeftCorner(p, p) = error.health_bias;
  state.mean.bottomRightCorner(p, l) = error.offset_bias;
  state.covariance.resize(n + p, n + p);
  state.covariance.topLeftCorner(n, n) = model.motion;
  state.covariance.topRightCorner(n, p) = error.motion_cross;
  state.covariance.bottomLeftCorner(p, n) = error.motion_cross.transpose();
  state.covariance.bottomRightCorner(p, p) = error.noise;
}

bool restore(const SnapshotModel& model, const ErrorState& state, SnapshotError& error) noexcept {
  const Eigen::Index n = model.states(), p = model.health(), l = model.offsets();
  if (state.mean.rows() != n + p || state.mean.cols() != p + l || state.covariance.rows() != n + p ||
      state.covariance.cols() != n + p)
    return false;
  error.health_bias = state.mean.bottomLeftCorner(p, p);
  error.offset_bias = state.mean.bottomRightCorner(p, l);
  error.motion_cross = state.covariance.topRightCorner(n, p);
  error.noise = state.covariance.bottomRightCorner(p, p);
  return true;
}

}  // namespace ehm::estimation
