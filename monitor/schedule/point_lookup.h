// SPDX-License-Identifier: Apache-2.0
#pragma once
// The point model of a schedule at the engine's present place: weights of the surrounding nodes, one sum over their
// numbers, scaled to the present theta and delta. Errors: none; outside the grid the nearest edge answers, and where
// the nodes around are mostly not valid there is no answer. Real-time safe: yes, all but construction.

#include <array>

#include "monitor/estimation/capacity.h"
#include "monitor/schedule/schedule.h"

namespace ehm::schedule {

/// Where the engine is.
struct Place {
  double n1_corrected_rpm = 0.0, mach = 0.0, theta = 1.0, delta = 1.0, altitude_m = 0.0;
};

struct PointModel {
  estimation::StateVector x0, lambda_x;
  estimation::ActuatorVector u0;
  estimation::SensorVector y0, lambda_y;
  estimation::AuxiliaryVector z0, lambda_z;
  estimation::BoundedMatrix<estimation::max_states, estimation::max_states> A;
  estimation::BoundedMatrix<estimation::max_states, estimation::max_actuators> B;
  estimation::BoundedMatrix<estimation::max_states, estimation::max_health> L;
  estimation::BoundedMatrix<estimation::max_sensors, estimation::max_states> C;
  estimation::BoundedMatrix<estimation::max_sensors, estimation::max_actuators> D;
  estimation::BoundedMatrix<estimation::max_sensors, estimation::max_health> M;
  estimation::BoundedMatrix<estimation::max_auxiliary, estimation::max_states> F;
  estimation::BoundedMatrix<estimation::max_auxiliary, estimation::max_actuators> G;
  estimation::BoundedMatrix<estimation::max_auxiliary, estimation::max_health> N;
};

class PointLookup {
 public:
  /// @throws std::invalid_argument if nodes and axes do not fit together (says which).
  explicit PointLookup(Schedule schedule);

  const Schedule& schedule() const noexcept { return schedule_; }
  /// False, and `model` unchanged, where there is no answer.
  bool at(const Place& place, PointModel& model) const noexcept;
  /// How far outside the grid, in cells at its edge; 0 within.
  double outside(const Place& place) const noexcept;
  /// The corrected fan speed at which the table's engine has this reading of actuator `u` (its fuel flow), by the
  /// nodes.
  double n1_of_actuator(Eigen::Index u, double value, Place place) const noexcept;

 private:
  struct Corner {
    Eigen::Index node;
    double weight;
  };
  static double coordinate(Variable variable, const Place& place) noexcept;
  int corners(const Place& place, std::array<Corner, 8>& around) const noexcept;
  void scale(const Place& place, PointModel& model) const noexcept;

  Schedule schedule_;
  Eigen::Index states_, actuators_, sensors_, auxiliary_, health_;
  Eigen::MatrixXd numbers_;  ///< of each node in a column, in the order of PointModel
};

}  // namespace ehm::schedule
