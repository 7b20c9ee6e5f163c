// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/flight/mission_scenario.h"

#include <algorithm>
#include <utility>

#include "engine_sim/scenario/mission.h"
#include "tuner_design/monte_carlo/random_stream.h"

namespace ehm::tuner_design {

namespace sim = engine_sim;

std::size_t stepped_channel(const sim::EngineDefinition& engine, std::size_t index) {
  return index % engine.channels.health.size();
}

std::size_t biased_sensor(const sim::EngineDefinition& engine, std::size_t index) {
  return index % engine.channels.sensors.size();
}

sim::Scenario mission_scenario(std::shared_ptr<const sim::EngineDefinition> engine, double step_s,
                               const MissionDraw& draw, std::size_t index) {
  RandomStream random(draw.seed, index);
  sim::Scenario s;
  s.engine = std::move(engine);
  s.control = s.engine->control;
  s.sample_time_s = step_s;
  s.seed = static_cast<std::int64_t>(random.bits() >> 12);
  s.heat_soak = draw.heat_soak;
  for (const sim::HealthChannel& health : s.engine->channels.health)
    s.wear[health.parameter].initial = health.sigma * std::clamp(random.normal(), -3.0, 3.0);
  s.mismatch = sim::drawn_mismatch(draw.mismatch, random.bits());
  const sim::MissionOptions mission{.delta_isa_k = std::clamp(8.0 * random.normal(), -20.0, 20.0),
                                    .offtake = 0.5 + random.uniform(),
                                    .power = 1.0 + 0.02 * (random.uniform() - 0.5)};
  if (draw.step) {
    const double sign = random.uniform() < 0.5 ? -1.0 : 1.0;
    s.health_changes.push_back({.time_s = draw.step->at_s,
                                .channel = stepped_channel(*s.engine, index),
                                .change = sign * 0.01 * draw.step->percent});
  }
  s.profile = sim::two_hour_mission(s.engine->data, mission);
  s.flight = s.profile.front().flight;
  s.demand = s.profile.front().demand;
  return s;
}

}  // namespace ehm::tuner_design
