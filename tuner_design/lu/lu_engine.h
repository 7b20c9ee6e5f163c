// SPDX-License-Identifier: Apache-2.0
#pragma once
// The set-up of Lu, Huang & Lv (constrained extended Kalman particle filter) on an engine of ours: sea level, static,
// fuel and nozzle area held; nine sensors, seven health parameters, as many sensors as unknowns.
//   sensors  N1 N2 P13 T24 P24 T30 P30 T50 P50, noise .15 % of trim, temperatures .2 %
//   health   SE1 SW1 SE2 SW2 SE3 SW3 SE4: efficiency and flow capacity of fan, HPC, HPT, efficiency of the LPT
// Their engine burns 2.5 kg/s; ours is trimmed at 95 % of its ratings instead, so that any engine file can be flown.
// Units: percent of health, channel units of sensors.
// Errors: @throws what solve_steady and OnBoardModel throw.

#include <array>
#include <memory>

#include "engine_sim/engines/engine_definition.h"
#include "engine_sim/model/solve/steady.h"
#include "monitor/estimation/estimator.h"
#include "monitor/onboard/on_board_model.h"

namespace ehm::tuner_design {

inline constexpr std::size_t lu_health_count = 7, lu_sensor_count = 9;
using LuHealth = Eigen::Matrix<double, lu_health_count, 1>;  ///< percent

inline constexpr std::array<const char*, lu_health_count> lu_health_names{"SE1", "SW1", "SE2", "SW2",
                                                                          "SE3", "SW3", "SE4"};
/// In the order of their table 8.
inline constexpr std::array<const char*, lu_sensor_count> lu_sensor_names{"Nf",  "Nc",  "P13", "T24", "P24",
                                                                          "T30", "P30", "T50", "P50"};
/// Of wear, at 6000 cycles; percent.
LuHealth lu_most_wear();
/// 1: SE2 -9 %.  2: SE1 -3, SE2 -9, SW3 +3 %.
LuHealth lu_fault(int number);

inline constexpr double lu_filter_step_s = 0.02, lu_model_step_s = 0.005;
inline constexpr double lu_health_noise_percent = 0.05;

struct LuEngine {
  std::shared_ptr<const onboard::OnBoardModel> model;
  engine_sim::SteadyPoint trim;
  estimation::Conditions conditions;
  estimation::SensorVector trim_readings, sigma;
  std::array<engine_sim::Health, lu_health_count> parameters;
};

LuEngine lu_engine(const engine_sim::EngineDefinition& engine);

}  // namespace ehm::tuner_design
