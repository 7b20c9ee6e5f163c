// SPDX-License-Identifier: Apache-2.0
#pragma once
// Linear point model of the nonlinear turbofan at a steady operating point, continuous time, channels of
// engine_channels.h: A in 1/s, B rpm/s per kg/s, L rpm/s per fraction, and so on.
//   tangent   derivatives at the trim engine by central differences at the step where they settle (step_study.h); each
//             block of columns, states, controls or health, can be made by another method instead (block_columns.h)
//   fleet     the best fit over engines with the fleet's spread of health (fleet_fit.h)
// States: N1, N2, with heat soak three metal temperatures (engine_channels.h), with sensor lags one state a lagging
// sensor: s' = (y - s)/tau, and s takes the place of y as the sensor's output.
// With a fleet, what either misses of the nonlinear engine is measured and becomes the model's linearisation_error.

#include <cstdint>
#include <memory>
#include <optional>

#include "engine_sim/engines/engine_definition.h"
#include "engine_sim/linear_model/linear_model.h"
#include "engine_sim/model/solve/steady.h"
#include "engine_sim/sensors/sensor_suite.h"
#include "tuner_design/linearise/block_columns.h"
#include "tuner_design/linearise/step_study.h"

namespace ehm::tuner_design {

enum class LineariseMethod { tangent, fleet };

/// In place of the tangent's columns, block by block.
struct BlockMethods {
  std::optional<ColumnMethod> states, controls, health;
  ColumnSteps steps;

  bool any() const { return states || controls || health; }
};

/// T40 of power code 100 at 35 000 ft, Mach 0.8 (2355.4 degR, reference/jt9d_npss_cases.csv).
inline constexpr double cruise_t40_k = 1308.6;

struct LineariseOptions {
  engine_sim::FlightCondition flight;
  engine_sim::HealthVector health{};
  engine_sim::Demand demand;
  double sample_time_s = 0.015;
  bool heat_soak = false;
  engine_sim::SensorOverrides sensors;  ///< in place of the engine file's noise and lags; a lag is a state
  double process_noise_percent = 0.01;  ///< of the speeds' trim, per sample
  LineariseMethod method = LineariseMethod::tangent;
  BlockMethods blocks;
  int fleet = 2000;        ///< engines of the fleet; 0: none, the linearisation error is not measured
  std::uint64_t seed = 1;  ///< of that fleet
};

struct Linearisation {
  linear_model::LinearModel model;  ///< continuous
  StepStudy study;                  ///< empty where no column is the tangent's
};

/// @throws what solve_steady throws if there is no steady point; std::invalid_argument if blocks are given to the fit.
/// @throws what study_steps, state_columns and its kin, steady_fleet and fit_fleet throw.
Linearisation linearise(std::shared_ptr<const engine_sim::EngineDefinition> engine, const LineariseOptions& options);

}  // namespace ehm::tuner_design
