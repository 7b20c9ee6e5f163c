// SPDX-License-Identifier: Apache-2.0
#pragma once
// One engine of the fleet at cruise in steps of 15 ms, its truth the engine file, and any nonlinear estimator beside it.

#include <algorithm>
#include <memory>

#include "engine_sim/engines/jt9d_engine.h"
#include "engine_sim/simulation.h"
#include "monitor/design/make_nonlinear.h"

namespace ehm::nonlinear::test {

inline constexpr double step_s = 0.015;

inline std::shared_ptr<const onboard::OnBoardModel> as_filed() {
  static const auto model = [] {
    onboard::OnBoardOptions options;
    options.build = options.soak = options.inputs = false;
    auto engine = std::make_shared<engine_sim::EngineDefinition>(*engine_sim::default_engine());
    for (engine_sim::SensorChannel& sensor : engine->channels.sensors) sensor.noise_of = engine_sim::NoiseOf::reading;
    return std::make_shared<const onboard::OnBoardModel>(std::move(engine), options);
  }();
  return model;
}

class CruiseEngine {
 public:
  explicit CruiseEngine(std::uint64_t seed) : simulation_(scenario(seed)) {}

  void next() {
    before = now;
    sample = simulation_.next_sample();
    now.flight = {sample.flight.altitude_m, sample.flight.mach, sample.flight.delta_isa_k};
    now.actuators = Eigen::Map<const Eigen::VectorXd>(sample.actuators.data(), as_index(sample.actuators.size()));
    y.resize(as_index(sample.sensors.size()));
    for (std::size_t i = 0; i < sample.sensors.size(); ++i) y(as_index(i)) = sample.sensors[i].value;
  }
  /// The next sample, through the estimator.
  void fly(estimation::Estimator& estimator, estimation::SensorMask available = estimation::SensorMask(127)) {
    next();
    estimator.use(available);
    estimator.predict(before, 1);
    estimator.innovate(y, now);
    estimator.update(available, 1);
  }
  void fly_for(double seconds, estimation::Estimator& estimator,
               estimation::SensorMask available = estimation::SensorMask(127)) {
    for (double t = 0.0; t < seconds; t += step_s) fly(estimator, available);
  }
  /// percent^2
  double squared_error(const estimation::Estimator& estimator) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < sample.health.size(); ++i) {
      const double e = 100.0 * (estimator.estimate().health(as_index(i)) - sample.health[i]);
      sum += e * e;
    }
    return sum;
  }
  engine_sim::Simulation& simulation() { return simulation_; }

  engine_sim::EngineSample sample;
  estimation::Conditions before, now;
  estimation::SensorVector y;

 private:
  static engine_sim::Scenario scenario(std::uint64_t seed) {
    engine_sim::Scenario s;
    s.seed = static_cast<std::int64_t>(seed);
    s.heat_soak = true;
    s.sensors.noise_of = engine_sim::NoiseOf::reading;
    NoiseSource random(1000 + seed);
    for (auto& wear : s.wear) wear.initial = 0.02 * std::clamp(random.normal(), -3.0, 3.0);
    return s;
  }
  engine_sim::Simulation simulation_;
};

}  // namespace ehm::nonlinear::test
