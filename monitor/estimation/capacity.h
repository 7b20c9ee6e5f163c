// SPDX-License-Identifier: Apache-2.0
#pragma once
// Vector and matrix types sized at run time within an engine's capacities. Storage is inside the object, so that
// nothing on the cycle path allocates.
//
// n states, m sensors, p health parameters, r auxiliary outputs, nu actuators, t tuners; augmented state [x; q], n + t.

#include <Eigen/Core>
#include <bitset>

#include "engine_sim/linear_model/capacity.h"

namespace ehm::estimation {

using linear_model::max_actuators;
using linear_model::max_auxiliary;
using linear_model::max_health;
using linear_model::max_name_length;
using linear_model::max_sensors;
using linear_model::max_states;
using linear_model::max_unit_length;
inline constexpr int max_tuners = 16;
inline constexpr int max_augmented = max_states + max_tuners;
static_assert(max_augmented == 32);
/// What is unknown of an engine but constant: health, sensors and auxiliary outputs each bring as many at most.
inline constexpr int max_unknowns = max_health + max_sensors + max_auxiliary;

template <int MaxRows>
using BoundedVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, MaxRows, 1>;
template <int MaxRows, int MaxCols>
using BoundedMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, MaxRows, MaxCols>;

using SensorVector = BoundedVector<max_sensors>;
using HealthVector = BoundedVector<max_health>;
using AuxiliaryVector = BoundedVector<max_auxiliary>;
using ActuatorVector = BoundedVector<max_actuators>;
using StateVector = BoundedVector<max_states>;
using TunerVector = BoundedVector<max_tuners>;
using HealthCovariance = BoundedMatrix<max_health, max_health>;
using AugmentedVector = BoundedVector<max_augmented>;

/// Bit i stands for sensor i of the model.
using SensorMask = std::bitset<max_sensors>;

}  // namespace ehm::estimation
