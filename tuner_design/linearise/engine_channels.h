// SPDX-License-Identifier: Apache-2.0
#pragma once
// The nonlinear engine as a function f(v) of a point of operation, with the channels that its engine file names:
//   v = [N1 N2 (Tm_hpc Tm_hpt Tm_lpt) | controls | health]     rpm, K, units of channel_table.h, fraction
//   f = [rates of the states | sensors | auxiliary]            rpm/s, K/s, units of channel_table.h
// evaluated on the quasi-steady gas path: flow balances closed, spools free to accelerate. The metal temperatures are
// states only where the layout has heat soak (heat_soak.h).

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/engines/engine_definition.h"
#include "engine_sim/linear_model/linear_model.h"
#include "engine_sim/model/solve/steady.h"
#include "engine_sim/model/turbofan.h"
#include "tuner_design/linearise/plant.h"

namespace ehm::tuner_design {

/// Whose v and f; sizes and offsets in them.
struct EngineLayout {
  std::shared_ptr<const engine_sim::EngineDefinition> engine;
  bool heat_soak = false;

  const engine_sim::NamedChannels& channels() const { return engine->channels; }
  Eigen::Index states() const { return 2 + (heat_soak ? as_index(engine_sim::metal_count) : 0); }
  Eigen::Index control_count() const { return as_index(channels().controls.size()); }
  Eigen::Index health_count() const { return as_index(channels().health.size()); }
  Eigen::Index sensor_count() const { return as_index(channels().sensors.size()); }
  Eigen::Index auxiliary_count() const { return as_index(channels().auxiliary.size()); }
  Eigen::Index controls() const { return states(); }                  ///< in v
  Eigen::Index health() const { return states() + control_count(); }  ///< in v
  Eigen::Index inputs() const { return health() + health_count(); }
  Eigen::Index sensors() const { return states(); }  ///< in f
  Eigen::Index auxiliary() const { return sensors() + sensor_count(); }
  Eigen::Index outputs() const { return auxiliary() + auxiliary_count(); }

  /// Positions in v of what the balance of the states settles at a held fan speed: states but N1, and the fuel flow.
  std::vector<Eigen::Index> settled_inputs() const;
};

/// v of a steady point: metal and gas have one temperature.
Eigen::VectorXd inputs_of(const EngineLayout& layout, const engine_sim::SteadyPoint& point);
/// f of a solved gas path.
Eigen::VectorXd outputs_of(const EngineLayout& layout, const engine_sim::GasPath& gas);
/// f(v) at the flight condition of `near`, solved from there.
/// @throws engine_sim::SolveError if the flow balances do not close.
Eigen::VectorXd evaluate(const EngineLayout& layout, const engine_sim::Turbofan& turbofan,
                         const engine_sim::SteadyPoint& near, const Eigen::VectorXd& v);

/// The size of each input for relative steps and disturbances: trim of speeds and temperatures, what channel_table.h
/// says of controls (of the fuel flow its trim), 1 for a health fraction.
Eigen::VectorXd input_size(const EngineLayout& layout, const Eigen::VectorXd& v);
/// The least value that the gas path accepts of each input: bleed valves, say, only open.
Eigen::VectorXd lowest_inputs(const EngineLayout& layout);

/// The engine about a steady point as the linearisation methods see it (plant.h). `turbofan` must live as long as the
/// plant; layout and trim are copied. @throws engine_sim::SolveError as evaluate().
Plant plant_of(const EngineLayout& layout, const engine_sim::Turbofan& turbofan, const engine_sim::SteadyPoint& trim);

/// Fills the channel lists of a model with trims `v` and `f`.
void name_channels(const EngineLayout& layout, linear_model::LinearModel& model, const Eigen::VectorXd& v,
                   const Eigen::VectorXd& f);
/// Splits df/dv into A B L, C D M, F G N.
void split_jacobian(const EngineLayout& layout, linear_model::LinearModel& model, const Eigen::MatrixXd& jacobian);

}  // namespace ehm::tuner_design
