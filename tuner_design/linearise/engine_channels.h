#pragma once
// The nonlinear engine as a function f(v) of a point of operation, and the order and names of its channels:
//   v = [N1 N2 (Tm_hpc Tm_hpt Tm_lpt) | Wf VSV VBV | ten health fractions]     rpm, K, kg/s, deg, fraction
//   f = [rates of the states | sensors | auxiliary]     rpm/s, K/s; Nf Nc P24 T24 Ps30 T30 T48; T40 T50 Fn SmLPC
// evaluated on the quasi-steady gas path: flow balances closed, spools free to accelerate. The metal temperatures are
// states only where the layout has heat soak (heat_soak.h). VSV is the angle off the schedule, positive closes.

#include <Eigen/Core>

#include "engine_sim/linear_model/linear_model.h"
#include "engine_sim/model/solve/steady.h"
#include "engine_sim/model/turbofan.h"

namespace ehm::tuner_design {

inline constexpr Eigen::Index engine_controls = 3, engine_health = engine_sim::health_count, engine_sensors = 7,
                              engine_auxiliary = 4;

/// Sizes and offsets in v and f.
struct EngineLayout {
  bool heat_soak = false;

  Eigen::Index states() const { return 2 + (heat_soak ? static_cast<Eigen::Index>(engine_sim::metal_count) : 0); }
  Eigen::Index fuel() const { return states(); }                      ///< in v; behind it VSV, VBV
  Eigen::Index health() const { return states() + engine_controls; }  ///< in v
  Eigen::Index inputs() const { return health() + engine_health; }
  Eigen::Index sensors() const { return states(); }  ///< in f
  Eigen::Index auxiliary() const { return sensors() + engine_sensors; }
  Eigen::Index outputs() const { return auxiliary() + engine_auxiliary; }
};

/// v of a steady point: metal and gas have one temperature.
Eigen::VectorXd inputs_of(const EngineLayout& layout, const engine_sim::SteadyPoint& point);
/// f of a solved gas path.
Eigen::VectorXd outputs_of(const EngineLayout& layout, const engine_sim::GasPath& gas);
/// f(v) at the flight condition of `near`, solved from there.
/// @throws engine_sim::SolveError if the flow balances do not close.
Eigen::VectorXd evaluate(const EngineLayout& layout, const engine_sim::Turbofan& turbofan,
                         const engine_sim::SteadyPoint& near, const Eigen::VectorXd& v);

/// The size of each input for relative steps and disturbances: trim of speeds, temperatures and fuel flow, 10 degrees,
/// a tenth of the flow, 1 for a health fraction.
Eigen::VectorXd input_size(const EngineLayout& layout, const Eigen::VectorXd& v);

/// Fills the channel lists of a model with trims `v` and `f`.
void name_channels(const EngineLayout& layout, linear_model::LinearModel& model, const Eigen::VectorXd& v,
                   const Eigen::VectorXd& f);
/// Splits df/dv into A B L, C D M, F G N.
void split_jacobian(const EngineLayout& layout, linear_model::LinearModel& model, const Eigen::MatrixXd& jacobian);

}  // namespace ehm::tuner_design
