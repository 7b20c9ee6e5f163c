// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/model/solve/steady.h"
#include "tuner_design/linearise/engine_channels.h"
#include "tuner_design/linearise/engine_match.h"
#include "tuner_design/monte_carlo/truth.h"

namespace ehm::tuner_design {
namespace {

using linear_model::Channel;
using linear_model::LinearModel;

/// Position of each of the design's channels among the engine's.
std::vector<Eigen::Index> positions(const std::vector<Channel>& wanted, const std::vector<Channel>& known,
                                    const std::string& kind) {
  std::vector<Eigen::Index> result;
  for (const Channel& channel : wanted) {
    for (std::size_t i = 0; i < known.size(); ++i)
      if (known[i].name == channel.name && known[i].unit == channel.unit) result.push_back(as_index(i));
    if (result.size() == as_size(&channel - wanted.data()) + 1) continue;
    std::string names;
    for (const Channel& name : known) names += (names.empty() ? "" : ", ") + name.name + " (" + name.unit + ")";
    throw std::invalid_argument("nonlinear truth: " + kind + " '" + channel.name + "' (" + channel.unit +
                                ") is none of the nonlinear engine's: " + names);
  }
  return result;
}

/// The turbofan at the design's flight condition and controls.
class Fleet {
 public:
  Fleet(const LinearModel& model, Hold hold, std::shared_ptr<const engine_sim::EngineDefinition> engine)
      : layout_{std::move(engine)}, turbofan_(layout_.engine->data) {
    require_engine(model, *layout_.engine, "nonlinear truth");
    LinearModel known;
    name_channels(layout_, known, Eigen::VectorXd::Zero(layout_.inputs()), Eigen::VectorXd::Zero(layout_.outputs()));
    sensors_ = positions(model.sensors, known.sensors, "sensor");
    auxiliary_ = positions(model.auxiliary, known.auxiliary, "auxiliary output");
    health_ = positions(model.health, known.health, "health parameter");
    controls_ = positions(model.controls, known.controls, "control");
    sensor_trim_ = linear_model::trims(model.sensors), auxiliary_trim_ = linear_model::trims(model.auxiliary);
    health_trim_ = linear_model::trims(model.health), control_trim_ = linear_model::trims(model.controls);
    set_trim(model);
    demand_ = demand_of(model, hold);
    new_engine_ = engine_sim::solve_steady(turbofan_, operation_, demand_);
  }

  std::optional<EngineInBalance> engine(const estimation::HealthVector& health) const {
    engine_sim::Operation worn = operation_;
    for (std::size_t i = 0; i < health_.size(); ++i) {
      const auto at = as_index(i);
      worn.health[parameter(i)] = health_trim_(at) + health(at);
    }
    try {
      const engine_sim::SteadyPoint point = engine_sim::solve_steady(turbofan_, worn, demand_, &new_engine_);
      const Eigen::VectorXd outputs = outputs_of(layout_, point.gas);
      const Eigen::VectorXd controls = inputs_of(layout_, point).segment(layout_.controls(), layout_.control_count());
      return EngineInBalance{outputs.segment(layout_.sensors(), layout_.sensor_count())(sensors_) - sensor_trim_,
                             outputs.tail(layout_.auxiliary_count())(auxiliary_) - auxiliary_trim_,
                             controls(controls_) - control_trim_};
    } catch (const engine_sim::SolveError&) {
      return std::nullopt;  // the caller counts these engines
    }
  }

  std::string description() const {
    std::ostringstream text;
    text << "nonlinear turbofan in balance, " << operation_.flight.altitude_m << " m, Mach " << operation_.flight.mach
         << ", ISA " << std::showpos << operation_.flight.delta_isa_k << std::noshowpos << " K, "
         << (demand_.kind == engine_sim::DemandKind::n1_rpm ? "fan speed held at " : "fuel flow held at ")
         << demand_.value << (demand_.kind == engine_sim::DemandKind::n1_rpm ? " rpm" : " kg/s");
    return text.str();
  }

 private:
  /// Of the design's health parameter i among the gas path's.
  engine_sim::Health parameter(std::size_t i) const { return layout_.channels().health[as_size(health_[i])].parameter; }
  void set_trim(const LinearModel& model) {
    operation_.flight = {model.operating_point->altitude_m, model.operating_point->mach,
                         model.operating_point->delta_isa_k};
    for (std::size_t i = 0; i < controls_.size(); ++i)
      layout_.channels().controls[as_size(controls_[i])]->of(operation_) = control_trim_(as_index(i));
    for (std::size_t i = 0; i < health_.size(); ++i) operation_.health[parameter(i)] = health_trim_(as_index(i));
  }

  engine_sim::Demand demand_of(const LinearModel& model, Hold hold) const {
    if (hold == Hold::fuel_flow) {
      if (operation_.fuel_flow_kg_s > 0.0) return {engine_sim::DemandKind::fuel_flow_kg_s, operation_.fuel_flow_kg_s};
      throw std::invalid_argument("nonlinear truth: the design has no control fuel_flow (kg/s) with a trim above 0");
    }
    for (const Channel& state : model.states)
      if (state.name == "Nf" && state.unit == "rpm") return {engine_sim::DemandKind::n1_rpm, state.trim};
    throw std::invalid_argument("nonlinear truth: the design has no state Nf (rpm) whose trim could be held");
  }

  EngineLayout layout_;
  engine_sim::Turbofan turbofan_;
  std::vector<Eigen::Index> sensors_, auxiliary_, health_, controls_;  ///< among the engine's channels
  Eigen::VectorXd sensor_trim_, auxiliary_trim_, health_trim_, control_trim_;
  engine_sim::Operation operation_;
  engine_sim::Demand demand_{};
  engine_sim::SteadyPoint new_engine_;
};

}  // namespace

Truth nonlinear_truth(const design::Design& design, Hold hold,
                      std::shared_ptr<const engine_sim::EngineDefinition> engine) {
  const auto fleet = std::make_shared<const Fleet>(design.model, hold, std::move(engine));
  return {fleet->description(), true,
          [fleet](const estimation::HealthVector& health) { return fleet->engine(health); }};
}

}  // namespace ehm::tuner_design
