// SPDX-License-Identifier: Apache-2.0
#pragma once
// An engine that is known as a linear model only, in flight: the model's own equations with its own noise.
//
//   x[k+1] = A x[k] + B u[k] + L h[k] + w[k]     w ~ N(0, process_noise)
//   y[k]   = C x[k] + D u[k] + M h[k]            sensor i reads trim + y_i with its noise, rounding and holding
//   z[k]   = F x[k] + G u[k] + N h[k]
//
// Shapes and units: engine_sim/linear_model/linear_model.h; x, y, z, u and h are deviations from trim. h is wear as the
// scenario and orders have it, with noise where the scenario says so (scenario/flown_health.h), u the planned changes
// of the controls, which else stay at their trims. The first sample is in balance, x = (I - A)^-1 (B u + L h) with the
// wear alone, about which w has moved the engine for long: that motion is stationary from there on.
// The model's linearisation_error is not flown: this engine is linear.
//
// Noise is drawn in the same order in every sample, so that the same seed gives the same flight, and a fault changes
// nothing but its own sensor.

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "engine_sim/scenario/fault_schedule.h"
#include "engine_sim/scenario/flown_health.h"
#include "engine_sim/scenario/linear_model_file.h"
#include "engine_sim/simulated_engine.h"

namespace ehm::engine_sim {

class LinearEngine : public SimulatedEngine {
 public:
  /// `model` as read_linear_model gives it. Of the scenario: seed, wear, changes, noise of health and faults, by
  /// the model's channels.
  /// @throws std::runtime_error if the model is so near to instability that its motion cannot be computed.
  LinearEngine(const linear_model::LinearModel& model, const Scenario& scenario);

  const EngineChannels& channels() const override { return channels_; }
  std::string start_text() const override;
  double time_s() const override { return static_cast<double>(sequence_) * model_.sample_time_s; }
  EngineSample next_sample() override;

  /// A linear model has neither demand nor flight condition. @throws std::invalid_argument
  void demand(const Demand& demand) override;
  double most_net_thrust_n() const override;
  bool can_fly(const FlightCondition& flight) const override;
  void fly(const FlightCondition& flight) override;

  HealthRange health_range(std::size_t parameter) const override;
  double health_of(std::size_t parameter) const override { return flown_health_.lasting(time_s(), parameter); }
  bool can_wear(std::size_t, double, double) const override { return true; }
  void order_health(std::size_t parameter, double target, double ramp_s) override {
    flown_health_.order(parameter, target, ramp_s, time_s());
  }
  void inject(std::size_t sensor, const SensorFault& fault) override { sensors_.at(sensor).inject(fault); }

 private:
  /// As it acts on the present sample.
  Eigen::VectorXd health_deviation() const;
  Eigen::VectorXd control_deviation() const;
  Eigen::VectorXd random(const Eigen::MatrixXd& root);
  std::vector<Reading> read(const Eigen::VectorXd& y);

  linear_model::LinearModel model_;
  EngineChannels channels_;
  FlownHealth flown_health_;
  std::vector<PlannedChange> control_changes_;
  FaultSchedule pending_faults_;
  std::vector<Sensor> sensors_;
  NoiseSource noise_;
  Eigen::MatrixXd motion_root_;  ///< of process_noise
  Eigen::VectorXd x_;
  std::uint64_t sequence_ = 0;
};

}  // namespace ehm::engine_sim
