#pragma once
// The nonlinear engine as a function f(v) of a point of operation, and the order and names of its channels:
//   v = [N1 N2 | Wf | ten health fractions]       rpm, kg/s, fraction                     13
//   f = [n1_dot n2_dot | sensors | auxiliary]     rpm/s; Nf Nc P24 T24 Ps30 T30 T48; T40 T50 Fn SmLPC      13
// evaluated on the quasi-steady gas path: flow balances closed, spools free to accelerate.

#include <Eigen/Core>

#include "engine_sim/model/steady.h"
#include "engine_sim/model/turbofan.h"
#include "monitor/estimation/linear_model.h"

namespace ehm::bench {

inline constexpr Eigen::Index engine_states = 2, engine_controls = 1, engine_health = engine::health_count,
                              engine_inputs = engine_states + engine_controls + engine_health;
inline constexpr Eigen::Index engine_rates = engine_states, engine_sensors = 7, engine_auxiliary = 4,
                              engine_outputs = engine_rates + engine_sensors + engine_auxiliary;

/// v of a steady point.
Eigen::VectorXd inputs_of(const engine::SteadyPoint& point);
/// f of a solved gas path.
Eigen::VectorXd outputs_of(const engine::GasPath& gas);
/// f(v) at the flight condition of `near`, solved from there.
/// @throws engine::SolveError if the flow balances do not close.
Eigen::VectorXd evaluate(const engine::Turbofan& turbofan, const engine::SteadyPoint& near, const Eigen::VectorXd& v);

/// Fills the channel lists of a model with trims `v` and `f`.
void name_channels(estimation::LinearModel& model, const Eigen::VectorXd& v, const Eigen::VectorXd& f);
/// Splits df/dv (13 x 13) into A B L, C D M, F G N.
void split_jacobian(estimation::LinearModel& model, const Eigen::MatrixXd& jacobian);

}  // namespace ehm::bench
