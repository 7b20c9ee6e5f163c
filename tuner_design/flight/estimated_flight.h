// SPDX-License-Identifier: Apache-2.0
#pragma once
// Flies a simulation on for `seconds`, with every sample through `spoil(y, t)`, which may alter the readings and
// answers which are good, and the estimator, and then to `told(sample, t)`; t: seconds since the call, of the sample.
// Errors: @throws engine_sim::FlightError if the engine does not fly.

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/simulation.h"
#include "monitor/estimation/estimator.h"

namespace ehm::tuner_design {

template <class Spoil, class Told>
void estimate_flight(engine_sim::Simulation& simulation, double seconds, double step_s,
                     estimation::Estimator& estimator, const Spoil& spoil, const Told& told) {
  estimation::Conditions before;
  const auto samples = static_cast<std::int64_t>(seconds / step_s);
  for (std::int64_t k = 0; k < samples; ++k) {
    const engine_sim::EngineSample sample = simulation.next_sample();
    estimation::SensorVector y(as_index(sample.sensors.size()));
    for (std::size_t i = 0; i < sample.sensors.size(); ++i) y(as_index(i)) = sample.sensors[i].value;
    estimation::Conditions now;
    now.flight = {sample.flight.altitude_m, sample.flight.mach, sample.flight.delta_isa_k};
    now.actuators = Eigen::Map<const Eigen::VectorXd>(sample.actuators.data(), as_index(sample.actuators.size()));
    if (k == 0) before = now;  // nothing acted before the first sample
    const estimation::SensorMask fused = spoil(y, static_cast<double>(k) * step_s);
    estimator.use(fused);
    estimator.predict(before, 1);
    estimator.innovate(y, now);
    estimator.update(fused, 1);
    before = now;
    told(sample, static_cast<double>(k) * step_s);
  }
}

}  // namespace ehm::tuner_design
