// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/faults/fault_flight.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/simulation.h"
#include "idl/wire_values.h"
#include "monitor/cycle/monitor_cycle.h"
#include "tuner_design/linearise/engine_match.h"
#include "tuner_design/monte_carlo/random_stream.h"

namespace ehm::tuner_design {
namespace {

constexpr double wait_s = 2.0;  // beyond the convergence of the filter

template <class Names>
void require_channels(const std::vector<linear_model::Channel>& channels, const Names& known, const char* kind) {
  std::string names;
  bool same = channels.size() == known.size();
  for (std::size_t i = 0; i < known.size(); ++i) {
    same = same && channels[i].name == known[i];
    names += (names.empty() ? "" : ", ") + std::string(known[i]);
  }
  if (!same)
    throw std::invalid_argument(std::string("study faults: the design has other ") + kind +
                                " than the engine, whose are " + names);
}

double fan_speed_trim(const linear_model::LinearModel& model) {
  for (const auto& state : model.states)
    if (state.name == "Nf" && state.unit == "rpm") return state.trim;
  throw std::invalid_argument("study faults: the design has no state Nf (rpm) whose trim the control could hold");
}

double settled_after_s(const design::Design& design) {
  return design.full.settling_s() + wait_s;
}

/// The flight of one engine of the fleet; what breaks is still to be added.
engine_sim::Scenario scenario_of(const StudyEngine& study, RandomStream& random) {
  engine_sim::Scenario scenario;
  scenario.engine = study.engine;
  scenario.control = study.engine->control;
  const auto& model = study.prepared.design->model;
  scenario.sample_time_s = model.sample_time_s;
  scenario.flight = {model.operating_point->altitude_m, model.operating_point->mach,
                     model.operating_point->delta_isa_k};
  scenario.demand = {engine_sim::DemandKind::n1_rpm, fan_speed_trim(model)};
  for (std::size_t i = 0; i < model.health.size(); ++i)
    scenario.wear[study.engine->channels.health[i].parameter].initial =
        model.health[i].trim + model.health_sigma(as_index(i)) * random.normal();
  scenario.seed = static_cast<std::int64_t>(random.bits() >> 12);
  return scenario;
}

FaultOutcome fly(const monitor::PreparedDesign& study, const engine_sim::Scenario& scenario, double onset_s,
                 double end_s, bool broken) {
  FaultOutcome outcome;
  std::optional<engine_sim::Simulation> flight;
  try {
    flight.emplace(scenario);
    monitor::MonitorCycle cycle(study, monitor::CycleOptions{});
    monitor::Sample sample;
    estimation::HealthVector before;
    for (int set = -1; flight->time_s() < end_s;) {
      const double now_s = flight->time_s();
      to_sample(flight->next_sample(), now_s, sample);
      cycle.process(sample);
      const double since_onset_s = 1e-9 * static_cast<double>(sample.source_time_ns) - onset_s;
      if (const int now = cycle.watch().filter().sensor_set().missing(); now != set) {
        set = now;
        const auto step =
            (cycle.watch().filter().health() - before).cwiseAbs().cwiseQuotient(cycle.watch().error().health_sigma());
        outcome.largest_step_sigmas = std::max(outcome.largest_step_sigmas, step.maxCoeff());
      }
      before = cycle.watch().filter().health();
      if (since_onset_s < 0.0 && !cycle.result().estimates) return {};
      for (const monitor::Event& event : cycle.events()) note_answer(event, since_onset_s, broken, outcome);
      cycle.clear_events();
    }
  } catch (const engine_sim::FlightError&) {
    return {};  // the caller counts them
  }
  outcome.flown = true;
  return outcome;
}

}  // namespace

StudyEngine study_engine(const design::Design& design, std::shared_ptr<const engine_sim::EngineDefinition> engine) {
  require_engine(design.model, *engine, "study faults");
  std::vector<std::string_view> sensors, health, controls;
  for (const auto& sensor : engine->channels.sensors) sensors.push_back(sensor.quantity->name);
  for (const auto& channel : engine->channels.health) health.push_back(engine_sim::health_names[channel.parameter]);
  for (const auto* control : engine->channels.controls) controls.push_back(control->name);
  require_channels(design.model.sensors, sensors, "sensors");
  require_channels(design.model.health, health, "health parameters");
  require_channels(design.model.controls, controls, "controls");
  fan_speed_trim(design.model);
  return {monitor::PreparedDesign(std::make_shared<const design::Design>(design)), std::move(engine)};
}

FaultOutcome fly_case(const StudyEngine& study, const FaultCase& what, std::uint64_t seed, std::uint64_t index) {
  RandomStream random(seed, index);
  engine_sim::Scenario scenario = scenario_of(study, random);
  const double onset_s = settled_after_s(*study.prepared.design) + random.uniform();
  const auto channel = as_index(what.channel);
  if (what.row->broken == Broken::component)
    scenario.health_changes.push_back(
        {onset_s, study.engine->channels.health[what.channel].parameter, what.row->size, 0.0});
  else if (what.row->broken != Broken::nothing)
    scenario.faults.push_back(
        {what.channel, sensor_fault(*what.row, study.prepared.design->model.sensor_noise_sigma(channel), onset_s,
                                    random.uniform() < 0.5 ? -1.0 : 1.0)});
  return fly(study.prepared, scenario, onset_s, onset_s + what.row->watched_s, what.row->broken != Broken::nothing);
}

FaultOutcome fly_healthy(const StudyEngine& study, double seconds, std::uint64_t seed, std::uint64_t index) {
  RandomStream random(seed, index);
  const engine_sim::Scenario scenario = scenario_of(study, random);
  const double onset_s = settled_after_s(*study.prepared.design);
  return fly(study.prepared, scenario, onset_s, onset_s + seconds, false);
}

}  // namespace ehm::tuner_design
