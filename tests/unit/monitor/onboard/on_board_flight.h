// SPDX-License-Identifier: Apache-2.0
#pragma once
// The two-hour mission of one perturbed engine with the on-board estimator beside it, at 10 Hz.

#include <memory>
#include <utility>
#include <vector>

#include "engine_sim/engines/jt9d_engine.h"
#include "engine_sim/scenario/mission.h"
#include "engine_sim/simulation.h"
#include "monitor/onboard/on_board_estimator.h"

namespace ehm::onboard::test {

struct OnBoardFlightOptions {
  std::uint64_t seed = 1;
  engine_sim::MismatchDraw mismatch{true, true, true};
  std::vector<std::size_t> missing = {};
  std::vector<engine_sim::PlannedChange> health_changes = {};
  OnBoardOptions options = {};
};

struct OnBoardFlight {
  static constexpr double step_s = 0.1;

  explicit OnBoardFlight(const OnBoardFlightOptions& o) : simulation(scenario(o)), estimator(model(o)) {
    for (std::size_t i = 0; i < 7; ++i) fused.set(i);
    for (const std::size_t sensor : o.missing) fused.reset(sensor);
    estimator.use(fused);
  }

  double time_s() const { return simulation.time_s(); }
  estimation::SensorVector measured() const {
    estimation::SensorVector y(as_index(sample.sensors.size()));
    for (std::size_t i = 0; i < sample.sensors.size(); ++i) y(as_index(i)) = sample.sensors[i].value;
    return y;
  }
  void next() { take(1); }
  /// So many samples are lost, then one comes.
  void skip(int lost) {
    for (int k = 0; k < lost; ++k) simulation.next_sample();
    take(lost + 1);
  }

  engine_sim::Simulation simulation;
  OnBoardEstimator estimator;
  estimation::SensorMask fused;
  estimation::Conditions now;
  engine_sim::EngineSample sample;

 private:
  void take(int steps) {
    const estimation::Conditions before = now;
    sample = simulation.next_sample();
    now.flight = {sample.flight.altitude_m, sample.flight.mach, sample.flight.delta_isa_k};
    now.actuators = Eigen::Map<const Eigen::VectorXd>(sample.actuators.data(), as_index(sample.actuators.size()));
    estimator.predict(before, steps);
    estimator.innovate(measured(), now);
    estimator.update(fused, 1);
  }
  static engine_sim::Scenario scenario(const OnBoardFlightOptions& o) {
    engine_sim::Scenario s;
    s.sample_time_s = step_s;
    s.seed = static_cast<std::int64_t>(o.seed);
    s.heat_soak = true;
    s.sensors.noise_of = engine_sim::NoiseOf::reading;
    s.health_changes = o.health_changes;
    s.mismatch = engine_sim::drawn_mismatch(o.mismatch, o.seed);
    NoiseSource random(1000 + o.seed);
    for (auto& wear : s.wear) wear.initial = 0.02 * random.normal();
    s.profile = engine_sim::two_hour_mission(s.engine->data, {});
    s.flight = s.profile.front().flight;
    s.demand = s.profile.front().demand;
    return s;
  }
  static std::shared_ptr<const OnBoardModel> model(const OnBoardFlightOptions& o) {
    OnBoardOptions options = o.options;
    options.sample_time_s = step_s;
    options.build = o.mismatch.build;
    options.soak = o.mismatch.soak;
    options.inputs = o.mismatch.inputs;
    return std::make_shared<const OnBoardModel>(engine_sim::default_engine(), options);
  }
};

}  // namespace ehm::onboard::test
