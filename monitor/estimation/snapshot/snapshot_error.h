// SPDX-License-Identifier: Apache-2.0
#pragma once
// Total error of a linear estimate of health from samples of an engine of the fleet (snapshot_model.h; h, o unit
// variance), so that the published sigma is honest whatever made the estimate:
//
//   hhat - h = Bh h + Bo o + eps       E[hhat - h | h, o] = [Bh Bo] [h; o],   cov([dx; eps]) = [cov(dx) Sx; Sx^T S]
//
//   nothing seen   Bh = -I, the rest 0
//   hhat = E e     Bh = E Hn - I,  Bo = E En,  Sx = cov(dx) Cn^T E^T,  S = E E^T + E Cn Sx
//
// and what is read off it, one row of variances for each channel, in the parts that grow apart beyond the fleet
// (VarianceParts): prior, nonlinear, noise.
//
//   health       Bh, Bo, S
//   outputs      zhat = F xu + G u + Hz hhat:    Hz Bh,  Hz Bo - Ez,  [-F Hz] cov([dx; eps]) [-F Hz]^T
//   innovations  e - Hn hhat of a later sample:  Hn Bh,  Hn Bo - En,  [-Cn Hn] cov([dx; eps]) [-Cn Hn]^T + I,  dx then
//
// p health, n states, l offsets; Bh p x p, Bo p x l, Sx n x p, S p x p. Health in sigmas of the fleet, readings in
// sigmas of their noise, outputs in scaled units. Source: theory.md, section 4. Errors: none. Real-time safe: yes, all
// of it.

#include "monitor/estimation/error_propagation.h"
#include "monitor/estimation/snapshot/snapshot_gain.h"

namespace ehm::estimation {

struct SnapshotError {
  HealthCovariance health_bias;                        ///< Bh
  BoundedMatrix<max_health, max_offsets> offset_bias;  ///< Bo
  BoundedMatrix<max_states, max_health> motion_cross;  ///< Sx
  HealthCovariance noise;                              ///< S
};

SnapshotError nothing_seen(const SnapshotModel& model) noexcept;
SnapshotError error_of(const SnapshotModel& model, const SnapshotGain& gain) noexcept;

/// A sample further: dx goes on by itself, eps stays.
void move_on(const SnapshotModel& model, SnapshotError& error) noexcept;

VarianceParts<max_health> health_variance(const SnapshotError& error) noexcept;
VarianceParts<max_auxiliary> auxiliary_variance(const SnapshotModel& model, const SnapshotError& error) noexcept;
VarianceParts<max_sensors> innovation_variance(const SnapshotModel& model, const SnapshotError& error) noexcept;
/// Of health, with this excess (VarianceParts); in the fleet's sigmas.
HealthCovariance health_covariance(const SnapshotError& error, double excess) noexcept;

/// In the form of all estimators: mean [0; Bh Bo], covariance of [dx; eps].
void save(const SnapshotModel& model, const SnapshotError& error, ErrorState& state) noexcept;
/// False, and nothing is changed, if the state is not of the model's shape.
bool restore(const SnapshotModel& model, const ErrorState& state, SnapshotError& error) noexcept;

}  // namespace ehm::estimation
