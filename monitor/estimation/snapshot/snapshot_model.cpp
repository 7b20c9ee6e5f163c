// SPDX-License-Identifier: Apache-2.0
#include "monitor/estimation/snapshot/snapshot_model.h"

#include "deploy/runtime/numbers/decompositions.h"
#include "engine_sim/linear_model/stationary_covariance.h"
#include "monitor/estimation/steady_gain.h"

namespace ehm::estimation {

SnapshotModel snapshot_model(const linear_model::LinearModel& model) {
  const FullOrderModel full = full_order_model(model);
  const SteadyGain steady = steady_gain(model);
  const Eigen::Index n = model.A.rows();
  const auto noise = model.sensor_noise_sigma.cwiseInverse().asDiagonal();
  const auto fleet = model.health_sigma.asDiagonal();
  SnapshotModel snapshot;
  snapshot.A = full.A;
  snapshot.B = full.B;
  snapshot.balance = (Eigen::MatrixXd::Identity(n, n) - model.A).partialPivLu().solve(model.B);
  snapshot.actuator_out = noise * model.D;
  snapshot.G = full.G;
  snapshot.health_signal = noise * steady.H * fleet;
  snapshot.offset_signal = noise * full.sensor_offset;
  snapshot.state_signal = noise * model.C;
  snapshot.health_output = steady.Hz * fleet;
  snapshot.offset_output = full.auxiliary_offset;
  snapshot.state_output = model.F;
  snapshot.motion = linear_model::stationary_covariance(model.A, model.process_noise);
  snapshot.noise_sigma = model.sensor_noise_sigma;
  snapshot.health_sigma = model.health_sigma;
  return snapshot;
}

}  // namespace ehm::estimation
