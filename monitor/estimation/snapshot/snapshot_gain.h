// SPDX-License-Identifier: Apache-2.0
#pragma once
// Two linear estimates hhat = E e of health from one sample (snapshot_model.h), of the sensors S that it has. E is
// p x m, the columns of all other sensors zero; health in sigmas of the fleet, readings in sigmas of their noise, so
// that Ph = I and R = I, and S on a matrix means its rows S.
//
//   map   E = Hn_S^T (Hn_S Hn_S^T + En_S En_S^T + Cn_S cov(dx) Cn_S^T + I)^-1        maximum a posteriori
//   wls   E = Hn_S^+                                                                 weighted least squares
//
// map is the best linear estimate from this sample alone: the mean of the Gaussian posterior. [SG] eq. 19 ff. is the
// same for a linear engine in balance, where only Hn Hn^T + I is left.
//
// wls is the health that explains the readings best, min (e - Hn h)^T (e - Hn h) with the weights R^-1, and of all
// those the one of least norm h^T h, that is h^T Ph^-1 h. With more sensors than parameters it is
// (H^T R^-1 H)^-1 H^T R^-1 y; with fewer, the usual case here, it takes every reading at its word, and what no sensor
// sees stays at the fleet's mean. A direction below a millionth of the strongest signal counts as unseen.
//
// **Why wls cannot be better.** map minimises the error covariance as a matrix: for any E, total(E) - total(map) =
// (E - E_map) Y (E - E_map)^T with Y the covariance of e, which is positive semidefinite. So no parameter, and no
// combination of them, is known better by wls. By how much, for an engine in balance and without Lambda: with the
// singular values s_i and right vectors v_i of Hn, each a signal-to-noise ratio,
//
//   variance along v_i over the prior's:   map 1/(1 + s^2),   wls 1/s^2,   wls - map 1/(s^2 (1 + s^2));   unseen 1, 1
//
// Nothing for s >> 1; for s < 1 wls is worse than knowing nothing. Tests: closed form and random models.
//
// Source: theory.md, sections 3 and 19; Endurthi's thesis, eq. 3.7 and 3.9 (weighted least squares); Penrose, Proc.
// Cambridge Phil. Soc. 52 (1956) 17 (least norm). Errors: none; no sensor gives E = 0. Real-time safe: yes, both.

#include "monitor/estimation/snapshot/snapshot_model.h"

namespace ehm::estimation {

using SnapshotGain = BoundedMatrix<max_health, max_sensors>;

SnapshotGain map_gain(const SnapshotModel& model, SensorMask sensors) noexcept;
SnapshotGain least_squares_gain(const SnapshotModel& model, SensorMask sensors) noexcept;

}  // namespace ehm::estimation
