// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/endurthi/study_engine.h"

#include <utility>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/model/parts/root_theta.h"

namespace ehm::tuner_design::endurthi {
namespace {

using engine_sim::find_control;
using engine_sim::find_output;

constexpr double share_of_capacity = 1.0 / 3.0;  ///< blades and discs, of all metal behind the LPT
constexpr double health_sigma = 0.02;            ///< the engine files' habit; no study here draws a fleet

struct NamedNoise {
  const char* name;
  double trim_over_sigma;
};
constexpr NamedNoise sensors[] = {{"P50", 100}, {"T50", 100}, {"Nf", 150},   {"T24", 100}, {"T30", 200},  {"P13", 100},
                                  {"P21", 200}, {"P24", 200}, {"Ps30", 100}, {"Nc", 150},  {"Tm_lpt", 70}};

engine_sim::NamedChannels channels() {
  engine_sim::NamedChannels list;
  for (const NamedNoise& sensor : sensors)
    list.sensors.push_back({find_output(sensor.name), 100.0 / sensor.trim_over_sigma});
  list.controls = {find_control("fuel_flow"), find_control("VSV"), find_control("A8")};
  using enum engine_sim::Health;
  for (const engine_sim::Health parameter : {fan_flow, fan_efficiency, lpc_flow, lpc_efficiency, hpc_flow,
                                             hpc_efficiency, hpt_flow, hpt_efficiency, lpt_efficiency})
    list.health.push_back({parameter, health_sigma});
  return list;
}

std::shared_ptr<const engine_sim::EngineDefinition> definition(const engine_sim::EngineDefinition& base) {
  auto engine = std::make_shared<engine_sim::EngineDefinition>(base);
  engine->channels = channels();
  auto& metal = engine->data.metal;
  metal[engine_sim::hpc_metal].conductance_w_k = metal[engine_sim::hpt_metal].conductance_w_k = 0.0;
  metal[engine_sim::lpt_metal].capacity_j_k *= share_of_capacity;
  for (auto* schedule : {&engine->control.bleed_valves.low_speed, &engine->control.bleed_valves.deceleration})
    for (auto& [at, fraction] : *schedule) fraction = 0.0;
  return engine;
}

/// A plant some of whose inputs and outputs are left where they are.
Plant kept(const Plant& all, const std::vector<Eigen::Index>& inputs, const std::vector<Eigen::Index>& outputs,
           Eigen::Index states) {
  const auto f = [all_f = all.f, v0 = all.v0, inputs, outputs](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    Eigen::VectorXd whole = v0;
    whole(inputs) = v;
    return all_f(whole)(outputs);
  };
  return {.states = states,
          .controls = all.controls,
          .health = all.health,
          .v0 = all.v0(inputs),
          .f0 = all.f0(outputs),
          .size = all.size(inputs),
          .lowest = all.lowest(inputs),
          .f = f};
}

/// The states that move: the metal of HPC and HPT takes no heat.
Plant three_states(const EngineLayout& layout, const Plant& all) {
  const Eigen::Index first_metal = 2;
  std::vector<Eigen::Index> states{0, 1, first_metal + as_index(std::size_t{engine_sim::lpt_metal})};
  std::vector<Eigen::Index> inputs = states, outputs = states;
  for (Eigen::Index j = layout.controls(); j < layout.inputs(); ++j) inputs.push_back(j);
  for (Eigen::Index i = layout.sensors(); i < layout.outputs(); ++i) outputs.push_back(i);
  return kept(all, inputs, outputs, as_index(states.size()));
}

/// Trim and plant of a point that has its name, engine, flight condition and demand.
StudyPoint with_trim(StudyPoint point, const engine_sim::HealthVector& health) {
  const StudyEngine& engine = *point.engine;
  point.trim = settled(engine.turbofan, engine.control(), {point.flight, health, {}}, point.n1_rpm);
  point.plant = three_states(engine.layout, plant_of(engine.layout, engine.turbofan, point.trim));
  return point;
}

StudyPoint point_at(std::string name, const std::shared_ptr<const StudyEngine>& engine,
                    const engine_sim::FlightCondition& flight, double share_of_design_n1) {
  const engine_sim::EngineData& data = engine->turbofan.data();
  const double design_corrected = data.design.speeds.n1_rpm / root_theta(data.inlet, data.design.flight);
  StudyPoint point = with_trim({.name = std::move(name),
                                .engine = engine,
                                .flight = flight,
                                .n1_rpm = share_of_design_n1 * design_corrected * root_theta(data.inlet, flight),
                                .trim = {},
                                .plant = {},
                                .noise_sigma = {}},
                               {});
  point.noise_sigma = point.sensor_trim();
  for (Eigen::Index i = 0; i < point.noise_sigma.size(); ++i) point.noise_sigma(i) /= sensors[i].trim_over_sigma;
  return point;
}

}  // namespace

StudyEngine::StudyEngine(const engine_sim::EngineDefinition& base)
    : layout{definition(base), true}, turbofan(layout.engine->data) {}

std::vector<std::string> StudyPoint::health_names() const {
  std::vector<std::string> names;
  for (const auto& health : engine->layout.channels().health)
    names.emplace_back(engine_sim::health_names[health.parameter]);
  return names;
}

engine_sim::HealthVector StudyPoint::health_of(const Eigen::VectorXd& h) const {
  engine_sim::HealthVector all{};
  Eigen::Index i = 0;
  for (const auto& health : engine->layout.channels().health) all[health.parameter] = h(i++);
  return all;
}

StudyPoint StudyPoint::worn(const Eigen::VectorXd& h) const {
  return with_trim(*this, health_of(h));
}

std::vector<StudyPoint> study_points(const engine_sim::EngineDefinition& base) {
  const auto engine = std::make_shared<const StudyEngine>(base);
  std::vector<StudyPoint> points;
  points.push_back(point_at("near idle, sea level static", engine, {0.0, 0.0, 0.0}, 0.49));
  points.push_back(point_at("part power, Mach 0.8, 35 000 ft", engine, {10668.0, 0.8, 0.0}, 0.94));
  return points;
}

}  // namespace ehm::tuner_design::endurthi
