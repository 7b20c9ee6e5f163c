// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/lu/lu_engine.h"

#include "deploy/runtime/numbers/index.h"
#include "monitor/onboard/engine_channels.h"

namespace ehm::tuner_design {
namespace {

namespace sim = engine_sim;

constexpr double share_of_ratings = 0.95;
constexpr std::array<const char*, lu_health_count> parameters{
    "fan_efficiency", "fan_flow", "hpc_efficiency", "hpc_flow", "hpt_efficiency", "hpt_flow", "lpt_efficiency"};

/// The engine with the paper's channels. The prior's sigma is that of a step of its process noise: they start at the truth.
sim::EngineDefinition with_channels(const sim::EngineDefinition& engine) {
  sim::EngineDefinition out = engine;
  out.channels = {};
  for (const char* name : lu_sensor_names) {
    const bool temperature = name[0] == 'T';
    out.channels.sensors.push_back({.quantity = sim::find_output(name), .noise_percent = temperature ? 0.2 : 0.15});
  }
  out.channels.controls = {sim::find_control("fuel_flow"), sim::find_control("A8")};
  for (const char* name : parameters)
    out.channels.health.push_back({static_cast<sim::Health>(sim::find_health(name)), 0.01 * lu_health_noise_percent});
  return out;
}

}  // namespace

LuHealth lu_most_wear() {
  return (LuHealth() << -2.85, -3.65, -9.4, -14.1, -3.81, 2.57, -1.08).finished();
}

LuHealth lu_fault(int number) {
  LuHealth fault = LuHealth::Zero();
  fault(2) = -9.0;
  if (number == 2) {
    fault(0) = -3.0;
    fault(5) = 3.0;
  }
  return fault;
}

LuEngine lu_engine(const sim::EngineDefinition& engine) {
  onboard::OnBoardOptions options;
  options.sample_time_s = lu_filter_step_s;
  options.build = options.soak = options.inputs = false;
  auto definition = std::make_shared<sim::EngineDefinition>(with_channels(engine));
  auto model = std::make_shared<const onboard::OnBoardModel>(definition, options);
  LuEngine out{.model = model,
               .trim = sim::solve_steady(model->engine(), sim::FlightCondition{}, {},
                                         {sim::DemandKind::limit_ratio, share_of_ratings}),
               .conditions = {},
               .trim_readings = {},
               .sigma = {},
               .parameters = {}};
  sim::Operation operation = out.trim.operation;
  const auto& controls = definition->channels.controls;
  out.conditions.actuators.resize(as_index(controls.size()));
  for (std::size_t i = 0; i < controls.size(); ++i) out.conditions.actuators(as_index(i)) = controls[i]->of(operation);
  out.trim_readings = onboard::EngineChannels(model).readings(out.trim.gas);
  out.sigma = out.trim_readings;
  for (std::size_t i = 0; i < lu_sensor_count; ++i)
    out.sigma(as_index(i)) *= 0.01 * definition->channels.sensors[i].noise_percent;
  for (std::size_t i = 0; i < lu_health_count; ++i) out.parameters[i] = definition->channels.health[i].parameter;
  return out;
}

}  // namespace ehm::tuner_design
