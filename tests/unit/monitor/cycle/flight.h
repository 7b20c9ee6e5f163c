// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sensor samples from the linear truth of a made-up engine with seven sensors and ten health parameters.

#include <memory>
#include <optional>

#include "monitor/cycle/monitor_cycle.h"
#include "monitor/data/sample.h"
#include "monitor/design/design.h"
#include "tests/unit/tuner_design/test_models.h"

namespace ehm::test {

/// Design of the made-up engine; made once.
std::shared_ptr<const design::Design> made_up_design();

class Flight {
 public:
  /// Starts in steady state with health `h` (channel units).
  Flight(const linear_model::LinearModel& model, const Eigen::VectorXd& h, std::uint64_t seed);

  /// The next sample in order; advances the engine.
  monitor::Sample next();
  /// Of the first actuator, deviation from trim; acts from the next sample on.
  void set_actuator(double du) { du_ = du; }
  /// From now on the engine moves by the model's process noise (a diagonal Q), as if it always had.
  void start_moving();
  void set_health(const Eigen::VectorXd& h) { h_ = h; }
  const Eigen::VectorXd& health() const { return h_; }
  Eigen::VectorXd auxiliary() const;

 private:
  linear_model::LinearModel model_;
  Eigen::VectorXd h_, x_;
  Eigen::VectorXd process_noise_sigma_;  ///< 0 while the engine does not move
  double du_ = 0.0;
  Random random_;
  std::uint64_t sequence_ = 0;
};

}  // namespace ehm::test
