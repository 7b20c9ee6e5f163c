#pragma once
// Capacities of one engine's estimator, and the vector and matrix types sized at run time within them. Storage is
// inside the object, so that nothing on the cycle path allocates. The sensor, health, auxiliary and actuator capacities
// are those of the wire (idl/engine_health.idl).
//
// n states, m sensors, p health parameters, r auxiliary outputs, nu actuators, t tuners; augmented state [x; q], n + t.

#include <Eigen/Core>
#include <bitset>

namespace ehm::estimation {

inline constexpr int max_sensors = 16;
inline constexpr int max_health = 16;
inline constexpr int max_auxiliary = 8;
inline constexpr int max_actuators = 8;
inline constexpr int max_states = 12;
inline constexpr int max_tuners = 16;
inline constexpr std::size_t max_name_length = 63, max_unit_length = 31;  ///< characters of a channel's name and unit
inline constexpr int max_augmented = max_states + max_tuners;
static_assert(max_augmented == 28);

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
using AugmentedVector = BoundedVector<max_augmented>;

/// Bit i stands for sensor i of the model.
using SensorMask = std::bitset<max_sensors>;

}  // namespace ehm::estimation
