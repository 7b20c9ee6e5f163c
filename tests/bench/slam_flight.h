// SPDX-License-Identifier: Apache-2.0
#pragma once
// The transient's workload for measurements: throttle slams (throttle_slam.h) at sea level, cruise and ceiling, with
// ramps of 1, 2.5 and 5 s, one after another, in steps of 15 ms. Endless.

#include <cstddef>
#include <optional>
#include <vector>

#include "engine_sim/model/solve/transient.h"
#include "tests/unit/engine_sim/model/throttle_slam.h"

namespace ehm::engine_sim {

class SlamFlight {
 public:
  static constexpr double dt_s = 0.015;
  static constexpr std::size_t steps_per_slam = 1200;
  static constexpr std::size_t steps_of_all = steps_per_slam * slam_flights.size() * slam_ramps_s.size();

  explicit SlamFlight(const Turbofan& engine) : engine_(engine) {
    for (const FlightCondition& flight : slam_flights) {
      for (const double ramp_s : slam_ramps_s) slams_.emplace_back(engine, flight, ramp_s);
    }
  }

  /// To be called before each step(): starts the next slam where one has ended, and looks up the operation.
  void prepare() {
    const std::size_t k = step_++ % steps_of_all;
    const ThrottleSlam& slam = slams_[k / steps_per_slam];
    if (k % steps_per_slam == 0) run_.emplace(engine_, slam.idle());
    operation_ = slam.at(dt_s * static_cast<double>(k % steps_per_slam));
  }

  /// What the simulator does every sample. Never inlined: callgrind counts it by its name.
  [[gnu::noinline]] double step() {
    const double t40_k = run_->output(operation_).s40.tt_k;
    run_->step(operation_, dt_s);
    return t40_k;
  }

 private:
  const Turbofan& engine_;
  std::vector<ThrottleSlam> slams_;
  std::optional<Transient> run_;
  Operation operation_;
  std::size_t step_ = 0;
};

}  // namespace ehm::engine_sim
