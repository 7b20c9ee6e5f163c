// SPDX-License-Identifier: Apache-2.0
#pragma once
// Linear point models of one engine over its envelope, as a table: nodes on a grid of one to three of
//   n1_corrected_rpm  N1/sqrt(theta)      mach      t2_k  288.15 theta      altitude_m
// Each node holds the engine's steady point there and its derivatives, all reduced to sea level by similarity: a
// channel
// reads  delta^a theta^b  times what the table says of it, a and b by its unit (tuner_design/envelope/engine_node.h), and time runs
// sqrt(theta)/delta times as long. A user's own models may stand there as they are (reduced = false).
//   dx/dt = A (x - x0) + B (u - u0) + L h
//   y = y0 + C (x - x0) + D (u - u0) + M h        z = z0 + F (x - x0) + G (u - u0) + N h
// n states, m sensors, p health parameters, r auxiliary outputs, nu actuators; health in percent, all else in channel
// units. lambda: root mean square of what the node's model misses of the fleet's engines in [dx/dt; y; z].
// Between nodes everything is linear in each variable; a node where the engine does not run is left out (valid =
// false). Errors: none here; @throws std::invalid_argument from whoever makes one of nodes that fill no grid.
// Source: Simon & Garg, NASA/TM-2010-216077 for the point model; similarity: Walsh & Fletcher, chapter 4.

#include <Eigen/Core>
#include <string>
#include <vector>

namespace ehm::schedule {

inline constexpr const char* variable_names[] = {"n1_corrected_rpm", "mach", "t2_k", "altitude_m"};
enum class Variable { n1_corrected, mach, t2, altitude };
inline constexpr int max_variables = 3;

/// What a channel is multiplied by: delta^delta_power theta^theta_power.
struct Similarity {
  double delta_power = 0.0, theta_power = 0.0;
};

struct Axis {
  Variable variable = Variable::n1_corrected;
  std::vector<double> points;  ///< ascending, at least two
};

struct Node {
  bool valid = false;
  Eigen::VectorXd x0, u0, y0, z0;
  Eigen::MatrixXd A, B, L, C, D, M, F, G, N;
  Eigen::VectorXd lambda_x, lambda_y, lambda_z;
};

struct Schedule {
  std::vector<Axis> axes;  ///< the first moves fastest among the nodes
  std::vector<Node> nodes;
  bool reduced = true;  ///< false: the nodes are as they are, and no similarity is used
  std::vector<Similarity> states, actuators, sensors, auxiliary;
  int fan_speed_state = 0;       ///< whose corrected value is n1_corrected_rpm
  Eigen::VectorXd eta_y, eta_z;  ///< gamma: percent of a reading (z: units) per percent of eta (theory.md, 13)
  double path_n1_rpm = 400.0, path_mach = 0.2;  ///< over which what a node misses becomes another
  double bias_factor = 1.4;                     ///< of lambda in the filter
};

}  // namespace ehm::schedule
