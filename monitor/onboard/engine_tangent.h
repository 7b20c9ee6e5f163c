// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the engine model answers at the estimate, and how that changes with every unknown.
//   rates      2 x n    d(dN/dt)/dxi      percent/s
//   readings   m x n    100/y dy/dxi      percent
//   outputs    r x n    dz/dxi            channel units
// Speeds and health: exact, by dual numbers (gas_path_jacobian.h), renewed when a speed has moved by
// refresh_speed or the tangent is refresh_time_s old. Causes of mismatch: the difference between the engine with one of
// them at its sigma and the engine, one cause a sample in turn, so that the cost of a sample is even. What is wrong of
// the metal is in the model itself: with conductance (1 + a) k, capacity (1 + b) C, D = T - Tm, the gas meets
//   Te = Tm - a D,   Tm' = k (T - Te)/((1 + b) C)
// and with M = d(k (T - Te)/C)/dTe and S = dTm/dc, integrated, its columns are y_Te E with
//   conductance   E = (1 + a) S - D,   S' = M E/(1 + b)
//   capacity      E = (1 + a) S,       S' = (M E - Tm')/(1 + b)
// With the speeds at rest each column becomes a settled one,  s = y_xi - y_x F_x^-1 F_xi,  which bounds what the model
// leaves out:
//   path variance    lambda_i^2 = share^2 sum_c s_ic^2 + eps^2 sum_j s_ij^2 sigma_j^2
//   metal            s_i of the three metal temperatures
// Real-time safe: yes, all but construction.

#include <memory>

#include "engine_sim/model/onboard/on_board_engine.h"
#include "monitor/onboard/engine_channels.h"
#include "monitor/onboard/engine_motion.h"

namespace ehm::onboard {

class EngineTangent {
 public:
  using Rates = estimation::BoundedMatrix<speed_count, max_unknowns>;
  using Readings = estimation::BoundedMatrix<estimation::max_sensors, max_unknowns>;
  using HealthReadings = estimation::BoundedMatrix<estimation::max_sensors, most_health>;
  using Outputs = estimation::BoundedMatrix<estimation::max_auxiliary, max_unknowns>;
  using MetalReadings = estimation::BoundedMatrix<estimation::max_sensors, 3>;
  using MetalOutputs = estimation::BoundedMatrix<estimation::max_auxiliary, 3>;

  explicit EngineTangent(std::shared_ptr<const OnBoardModel> model);

  /// Forgets the tangent: the next answer has a new one, with the metal as the model has it.
  void forget() noexcept {
    age_samples_ = -1;
    metal_by_cause_.setZero();
    soak_k_.setZero();
  }
  /// The metal goes on for dt_s from the last answer.
  void advance_metal(double dt_s, EngineMotion& motion) noexcept;
  /// The engine in this motion under this operation. False: it has no answer, and what was, stands.
  bool answer(const engine_sim::Operation& operation, const EngineMotion& motion) noexcept;

  const engine_sim::GasPath& gas() const noexcept { return gas_; }
  const Rates& rates() const noexcept { return rates_; }
  const Readings& readings() const noexcept { return readings_; }
  const Outputs& outputs() const noexcept { return outputs_; }
  /// Of the readings by health, the speeds having come to rest; percent.
  const HealthReadings& settled_health() const noexcept { return settled_health_; }
  /// Gas minus metal, K.
  const Eigen::Vector3d& soak_k() const noexcept { return soak_k_; }
  const MetalReadings& metal_readings() const noexcept { return metal_readings_; }
  const MetalOutputs& metal_outputs() const noexcept { return metal_outputs_; }
  const estimation::SensorVector& path_variance() const noexcept { return path_variance_; }
  const estimation::AuxiliaryVector& path_output_variance() const noexcept { return path_output_variance_; }

  /// Predicted readings and outputs in channel units, and the spools' rates in percent/s, of a gas path.
  estimation::SensorVector readings_of(const engine_sim::GasPath& gas) const noexcept {
    return channels_.readings(gas);
  }
  estimation::AuxiliaryVector outputs_of(const engine_sim::GasPath& gas) const noexcept {
    return channels_.outputs(gas);
  }
  Eigen::Vector2d rates_of(const engine_sim::GasPath& gas) const noexcept { return channels_.rates(gas); }
  /// Of which the answers come: where a start looks for its speeds.
  engine_sim::OnBoardEngine& engine() noexcept { return engine_; }
  /// d(dN/dt)/dN, 1/s.
  Eigen::Matrix2d speed_rates() const noexcept { return rates_.leftCols<speed_count>(); }

 private:
  bool due(const EngineMotion& motion) const noexcept;
  void renew(const engine_sim::GasPathJacobian& jacobian) noexcept;
  engine_sim::MetalTemperatures effective_metal(const EngineMotion& motion) const noexcept;
  void measure_soak(const EngineMotion& motion) noexcept;
  Eigen::Vector3d metal_shift(CauseKind kind, const EngineMotion& motion) const noexcept;
  void renew_soak_causes(const EngineMotion& motion) noexcept;
  void renew_cause(Eigen::Index cause, const engine_sim::Operation& operation, const EngineMotion& motion) noexcept;
  void settle() noexcept;

  std::shared_ptr<const OnBoardModel> model_;
  UnknownLayout layout_;
  EngineChannels channels_;
  engine_sim::OnBoardEngine engine_;
  engine_sim::GasPath gas_{};
  Rates rates_;
  Readings readings_;
  Outputs outputs_;
  Eigen::Matrix<double, speed_count, 3> metal_rates_;
  Eigen::Matrix3d metal_by_metal_;              ///< M, 1/s
  Eigen::Matrix<double, 3, 2> metal_by_cause_;  ///< S of conductance and capacity, K
  HealthReadings settled_health_;
  MetalReadings direct_metal_readings_, metal_readings_;
  MetalOutputs direct_metal_outputs_, metal_outputs_;
  estimation::SensorVector path_variance_;
  estimation::AuxiliaryVector path_output_variance_;
  Eigen::Vector3d soak_k_{0.0, 0.0, 0.0};
  engine_sim::SpoolSpeeds renewed_at_{};
  int age_samples_ = -1;      ///< of the tangent; -1: there is none
  Eigen::Index waiting_ = 0;  ///< causes whose columns are older than the tangent
};

}  // namespace ehm::onboard
