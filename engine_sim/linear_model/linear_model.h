// SPDX-License-Identifier: Apache-2.0
#pragma once
// Linear point model of an engine ([SG] = Simon & Garg, NASA/TM-2010-216077, eq. 1), deviations from trim:
//
//   discrete    x[k+1] = A x + B u + L h + w      continuous    dx/dt = A x + B u + L h
//               y      = C x + D u + M h + v                    y     = C x + D u + M h + v
//               z      = F x + G u + N h                        z     = F x + G u + N h
//
// A n x n, B n x nu, L n x p, C m x n, D m x nu, M m x p, F r x n, G r x nu, N r x p. The matrices are in the units of
// the channels (a health column in `fraction` is per unit fraction, in `percent` per percent); continuous time in
// seconds. w has covariance process_noise (n x n, states' units squared) per sample, in either time form; v and the
// fleet's h are independent with the given standard deviations, in channel units.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "deploy/runtime/numbers/index.h"

namespace ehm::linear_model {

struct Channel {
  std::string name;
  std::string unit;
  double trim = 0.0;  ///< value at the point of linearisation, in `unit`
};

/// Their trims, in their units.
inline Eigen::VectorXd trims(const std::vector<Channel>& channels) {
  Eigen::VectorXd trims(as_index(channels.size()));
  for (std::size_t i = 0; i < channels.size(); ++i) trims(as_index(i)) = channels[i].trim;
  return trims;
}

inline std::vector<std::string> names_of(const std::vector<Channel>& channels) {
  std::vector<std::string> names;
  for (const Channel& channel : channels) names.push_back(channel.name);
  return names;
}

/// Where the model holds.
struct OperatingPoint {
  double altitude_m = 0.0;
  double mach = 0.0;
  double delta_isa_k = 0.0;
};

struct LinearModel {
  std::string name;
  bool discrete = true;
  double sample_time_s = 0.0;
  std::vector<Channel> states, controls, health, sensors, auxiliary;
  Eigen::VectorXd health_sigma;        ///< p, spread over the fleet
  Eigen::VectorXd sensor_noise_sigma;  ///< m, of one sample, with rounding and holding (sensor_noise.h)
  /// m each, or empty where no sensor states it; 0 where one does not. Step of the values in channel units, and time
  /// between two values.
  Eigen::VectorXd sensor_resolution, sensor_update_period_s;
  Eigen::MatrixXd process_noise;  ///< n x n
  Eigen::MatrixXd A, B, L, C, D, M, F, G, N;
  /// What the real engine's [y; z] adds to the linear one's in steady state: second moment over the fleet, (m+r) x
  /// (m+r), channel units. Empty where the engine is linear or nobody has measured it. It acts like a constant sensor
  /// offset.
  Eigen::MatrixXd linearisation_error;
  std::optional<OperatingPoint> operating_point;
  std::string engine_type;  ///< empty where the file does not say
  std::string engine_hash;  ///< SHA-256 of the engine that was linearised (engine_file.h); empty where it does not say
};

}  // namespace ehm::linear_model
