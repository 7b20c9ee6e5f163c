// SPDX-License-Identifier: Apache-2.0
#pragma once
// One row of a recording: a sample as it came from the wire with what was estimated from it, or a marker: something
// else that acted on the filter between two samples.
//
// Plain values of fixed size, so that a row passes a queue without allocation. The columns and their meaning for users:
// deploy/docs/recording.md.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace ehm::recording {

inline constexpr std::size_t flight_channels = 3;  ///< altitude_m, mach, delta_isa_k
inline constexpr std::size_t max_actuators = 8, max_sensors = 16, max_health = 16, max_auxiliary = 8;
inline constexpr int max_shadows = 32;  ///< estimators beside published ones
inline constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

enum class RowKind : std::int64_t {
  sample = 0,
  input_lost = 1,      ///< no sample for age_ns: the source is released
  reset = 2,           ///< an operator restarted the filter
  resumed = 3,         ///< the filter did not start cold, but from a checkpoint or by a reload
  described_anew = 4,  ///< the source described its channels otherwise: the filter restarted
  left = 5,            ///< silent for so long that its filter was given back
  chosen = 6,          ///< an order has chosen whose estimates are published; age_ns: idl::EstimatorNumber
  rested = 7,          ///< an estimator overran its budget and rests from here on; age_ns as of chosen
  shadow = 16          ///< what another estimator made of the sample before it; 17 to 47: the second and further ones
};

/// Table A: all whole numbers, in the order of its columns (layout.h names them). Unsigned values of the wire keep
/// their bits.
struct Identity {
  std::int64_t unit = 0;  ///< engine_id; 0 is reserved and marks a row that was never written
  std::int64_t sequence = 0;
  std::int64_t source_time_ns = 0;
  std::int64_t received_ns = 0;  ///< the monitor's monotonic clock
  std::int64_t kind = 0;         ///< RowKind
  std::int64_t age_ns = 0;       ///< by RowKind; input_lost: of the last sample
  std::int64_t schema = 0;
  std::int64_t source_id = 0;
  std::int64_t writer = 0;  ///< tells writers with the same source_id apart; 0: not known
  std::int64_t sensor_valid = 0;
  std::int64_t sensor_count = 0;
  std::int64_t actuator_count = 0;
  std::int64_t accepted = 0;   ///< 0: dropped (malformed, duplicate, overtaken, foreign)
  std::int64_t estimates = 0;  ///< 1: T and X_v hold; else they are NaN
  std::int64_t flags = 0;
  std::int64_t sensors_used = 0;
  std::int64_t fused = 0;
  std::int64_t rejected = 0;
  std::int64_t design = 0;       ///< row of design_hash
  std::int64_t lost_before = 0;  ///< rows that the queue refused since the start, before this one
};
inline constexpr std::size_t identity_columns = 20;
static_assert(sizeof(Identity) == identity_columns * sizeof(std::int64_t));

template <std::size_t Size>
constexpr std::array<double, Size> no_values() {
  std::array<double, Size> values{};
  values.fill(no_value);
  return values;
}

struct Row {
  Identity a;
  std::array<double, flight_channels + max_actuators> w = no_values<flight_channels + max_actuators>();
  std::array<double, max_sensors> x_s = no_values<max_sensors>();
  std::array<double, max_sensors> innovation = no_values<max_sensors>();
  std::array<double, max_auxiliary> x_v = no_values<max_auxiliary>();
  std::array<double, max_auxiliary> x_v_sigma = no_values<max_auxiliary>();
  std::array<double, max_auxiliary> x_v_sigma_filter = no_values<max_auxiliary>();
  std::array<double, max_health> t = no_values<max_health>();
  std::array<double, max_health> t_sigma = no_values<max_health>();
  std::array<double, max_health> t_sigma_filter = no_values<max_health>();

  RowKind kind() const noexcept { return static_cast<RowKind>(a.kind); }
  /// Of which of the file's shadow estimators (FileInfo), -1: of none.
  int shadow() const noexcept {
    const std::int64_t number = a.kind - static_cast<std::int64_t>(RowKind::shadow);
    return number >= 0 && number < max_shadows ? static_cast<int>(number) : -1;
  }
};

}  // namespace ehm::recording
