// SPDX-License-Identifier: Apache-2.0
#pragma once
// A small checkpoint with different numbers everywhere.

#include "monitor/checkpoint/checkpoint.h"

namespace ehm::test {

inline monitor::Checkpoint some_checkpoint(std::uint32_t engine_id = 7) {
  monitor::Checkpoint c;
  c.engine_id = engine_id;
  c.design_hash = std::string(64, 'a');
  c.wall_time_ns = 1'700'000'000'000'000'123;
  c.state.source_id = 3;
  c.state.sequence = 12345;
  c.state.source_time_ns = -9'000'000'000'000'000'001;  // a source's clock may be anything
  c.state.watch.missing_sensor = 2;
  c.state.watch.held_samples = 5;
  c.state.excluded.set(2);
  c.state.watch.estimate = Eigen::VectorXd::LinSpaced(4, -1.0 / 3.0, 0.1);
  c.state.watch.error.mean = Eigen::MatrixXd::Constant(4, 3, 1e-17);
  c.state.watch.error.covariance = Eigen::MatrixXd::Identity(4, 4) / 7.0;
  c.state.watch.error.remaining = 11;
  c.state.return_gate = {0.25, 0.5, 2.0, 17.0};
  c.state.bias_return = {5, -12.5, 20.0, 3.0};
  c.state.companions.push_back({"time_varying", {.error = c.state.watch.error}});
  c.state.companions.back().state.estimate = Eigen::VectorXd::LinSpaced(4, 0.7, -1.0 / 3.0);
  c.state.companions.back().state.error.mean.resize(4, 0);  // a model without nonlinearity
  return c;
}

}  // namespace ehm::test
