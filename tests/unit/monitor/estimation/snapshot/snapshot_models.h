// SPDX-License-Identifier: Apache-2.0
#pragma once
// Scaled models for the tests of the snapshot estimators: random ones, in balance or not, with Lambda or without.

#include <memory>

#include "monitor/estimation/snapshot/snapshot_model.h"
#include "tests/unit/tuner_design/test_models.h"

namespace ehm::estimation::test_snapshot {

/// The made-up engine with other sensors, health, spread, noise and Lambda by the seed.
linear_model::LinearModel random_engine(int sensors, int health, std::uint64_t seed);
/// The same in balance, and as its linear model: no process noise, no Lambda.
linear_model::LinearModel in_balance(linear_model::LinearModel model);

/// JT9D at cruise as in theory.md, section 5, in balance.
linear_model::LinearModel jt9d_in_balance();

/// H = C (I-A)^-1 L + M and its kin, as the papers write them; scaled units.
struct Textbook {
  explicit Textbook(const linear_model::LinearModel& model);
  Eigen::MatrixXd H, Hz, Ph, R, motion;  ///< motion: cov(dx)
};

/// Rows of some sensors.
Eigen::MatrixXd rows(const Eigen::MatrixXd& all, SensorMask sensors);

inline SensorMask first(int sensors) {
  return SensorMask((1u << sensors) - 1);
}

}  // namespace ehm::estimation::test_snapshot
