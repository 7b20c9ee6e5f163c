// SPDX-License-Identifier: Apache-2.0
#pragma once
// What each fault does to the innovations: the constants of the generalised likelihood ratio test, by sensor set.
//
// Hypotheses j: a step of the bias of sensor i by one noise sigma (j = i, m of them), and a step of health parameter i
// by one percent (j = m + i, p of them), both at age 0. Their answer runs through the closed loop of the filter:
//
//   engine      x[0] = 0, x[a+1] = A x[a] + L e_i,  y[a] = C x[a] + M e_i        health; u is known and drops out
//   sensor      y[a] = sigma_i e_i
//   filter      xi[a] = Acl xi[a-1] + K y[a],  g[a] = y[a] - Cxq Axq xi[a-1],    Acl = (I - K Cxq) Axq
//
// g_j[a] (m) is the signature in the innovations, xi_j[a] (n+t) what the fault has put into the filter's state. While
// nothing happens the innovations of an engine with constant health have the covariance
//
//   S = Cxq Axq Sx Axq^T Cxq^T + C Q C^T + R,   Sx = Acl Sx Acl^T + K R K^T + (I - K Cxq) Qw (I - K Cxq)^T
//
// (Q the engine's process noise, Qw = blkdiag(Q, 0): error_propagation.h) below the filter's own, which believes in
// moving health. They are slightly coloured, negatively, since the filter takes up some noise and gives it back (lag
// one: -0.01 to -0.09 at Qh 1e-3): their sums scatter less than white ones do, and thresholds for white noise hold.
// A set with fewer tuners than sensors cannot follow every steady value. Its innovations have a constant mean over the
// fleet, (I - Cxq Axq (I - Acl)^-1 K) [H Ph^1/2, Lambda^1/2] with Lambda the linearisation error, which is no fault; B
// are its directions where it exceeds 0.05 of the noise, none between probes of one quantity: where these disagree one
// is biased. S^-1 stands without them: S^-1 - S^-1 B (B^T S^-1 B)^-1 B^T S^-1. Scaled units (percent). Source: Willsky
// & Jones, IEEE Trans. AC-21 (1976) 108; Basseville & Nikiforov, Detection of Abrupt Changes, ch. 7.

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "deploy/runtime/numbers/index.h"
#include "monitor/design/design.h"

namespace ehm::monitor {

/// Of one sensor set. Hypotheses of sensors that the set does not use have information 0.
struct FaultSignatures {
  int sensors = 0, hypotheses = 0, ages = 0;
  Eigen::MatrixXd weight;             ///< hypotheses x (m ages): block a is [S^-1 g_j[a]]^T, scaled sensors
  Eigen::MatrixXd information;        ///< hypotheses x ages: J_j[a] = sum of g^T S^-1 g up to a, plus the prior's
  Eigen::MatrixXd state;              ///< (n+t) x (m ages): block a is xi[a] of the sensors' hypotheses
  Eigen::MatrixXd steady_state;       ///< (n+t) x m: its limit, (I - Acl)^-1 K sigma_i e_i
  Eigen::MatrixXd inverse_S;          ///< m x m, 0 for unused sensors and in the directions B
  Eigen::VectorXd innovation_sigma;   ///< m, root of the diagonal of S, scaled; 1 for unused sensors
  Eigen::Index settling_samples = 0;  ///< of a cold start, until the innovations are noise
};

/// All sets of a design; shared by the engines that fly it.
struct FaultTables {
  FaultSignatures full;
  std::vector<std::optional<FaultSignatures>> missing;      ///< as Design::missing
  Eigen::VectorXd sensor_scale, noise_sigma, health_scale;  ///< channel units per scaled unit; sigma in channel units
  const FaultSignatures& of(int missing_sensor) const noexcept {
    return missing_sensor < 0 ? full : *missing[as_size(missing_sensor)];
  }
};

/// Evidence for one onset is gathered for three seconds: an abrupt fault is found within them, or not as an abrupt one.
std::shared_ptr<const FaultTables> fault_tables(const design::Design& design);

}  // namespace ehm::monitor
