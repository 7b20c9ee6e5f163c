// SPDX-License-Identifier: Apache-2.0
#pragma once
// The documented values behind the unsigned long fields of engine_health.idl, schema 1.
// Values are never reused or renumbered: subscribers of any version read them.

#include <cstdint>

namespace ehm::idl {

inline constexpr std::uint32_t schema_version = 1;

/// EngineHealth.flags, EngineAuxiliary.flags, MonitorStatus.flags: bits.
namespace estimate_flag {
/// The filter started less than seven of its slowest time constants ago.
inline constexpr std::uint32_t converging = 1u << 0;
/// A sensor of the design was predicted, not fused, or a word of flight condition or actuators was replaced by the last
/// good one.
inline constexpr std::uint32_t bridging = 1u << 1;
inline constexpr std::uint32_t degraded = 1u << 2;     ///< a design without some sensor flies
inline constexpr std::uint32_t off_design = 1u << 3;   ///< outside the design's operating point or sample time
inline constexpr std::uint32_t shifted = 1u << 4;      ///< a health shift event is raised
inline constexpr std::uint32_t implausible = 1u << 5;  ///< farther out than the fleet's engines are: sigma has grown
inline constexpr std::uint32_t fallback = 1u << 6;     ///< of the watch filter: the published estimator has no answer
}  // namespace estimate_flag

/// EngineResiduals.reason: bits, why a sensor was not fused.
namespace reject_reason {
inline constexpr std::uint32_t source_invalid = 1u << 0;  ///< the source's validity bit is off
inline constexpr std::uint32_t not_finite = 1u << 1;
inline constexpr std::uint32_t range = 1u << 2;
inline constexpr std::uint32_t rate = 1u << 3;
inline constexpr std::uint32_t stuck = 1u << 4;
inline constexpr std::uint32_t innovation_gate = 1u << 5;
inline constexpr std::uint32_t excluded = 1u << 6;   ///< declared faulty, requalifying
inline constexpr std::uint32_t withheld = 1u << 7;   ///< no estimate was made: off design, or too few sensors
inline constexpr std::uint32_t bias = 1u << 8;       ///< named by the fault detector
inline constexpr std::uint32_t noise = 1u << 9;      ///< named by the fault detector
inline constexpr std::uint32_t repeated = 1u << 10;  ///< a value that a slow sensor still holds: fused once already
inline constexpr std::uint32_t quiet = 1u << 11;     ///< with stuck: its values differ, but its noise is missing
}  // namespace reject_reason

enum class DescriptionRole : std::uint32_t { source = 1, monitor = 2 };

enum class StatusLevel : std::uint32_t {
  ok = 0,
  warn = 1,    ///< estimates flow, with a restriction (degraded, off design, shift, losses, stamps that do not measure)
  error = 2,   ///< input arrives, but no estimate can be made
  stale = 3,   ///< no input for three periods
  stopped = 4  ///< the monitor has shut down in order
};

/// MonitorStatus.flight_phase, and the places of FlightSummary.phase_s.
enum class FlightPhase : std::uint32_t {
  unknown = 0,
  taxi = 1,
  take_off = 2,  ///< from take-off power on, and the first 450 m
  climb = 3,
  cruise = 4,
  descent = 5,
  approach = 6  ///< below 3000 m, and slow
};

enum class EventKind : std::uint32_t {
  sensor_fault = 1,  ///< channel: sensor; value: bias in its unit, factor on its noise, or ratio; threshold: its limit
  health_shift = 2,  ///< channel: health parameter; value: change, threshold: what noise explains
  health_limit = 3,  ///< channel: health parameter; configured threshold
  auxiliary_limit = 4,    ///< channel: auxiliary output; configured threshold
  input_lost = 5,         ///< value: age in seconds
  filter_restart = 6,     ///< value: seconds of the jump in time or sequence that caused it; the message says which
  operating_point = 7,    ///< value: distance from the design's point, threshold: 1
  no_design = 8,          ///< no design for the sensors that are left
  sample_time = 9,        ///< value: the source's mean sample time in s, threshold: the design's
  second_source = 10,     ///< value: source_id that is not listened to, threshold: the one that is
  ambiguous_fault = 11,   ///< something changed abruptly, sensor or component cannot be told; channel: likeliest sensor
  slow_bias = 12,         ///< channel: sensor; a drift that the fleet's wear does not explain, or (raised 0) its end;
                          ///< value: bias, or step back, sensor unit
  checkpoint = 13,        ///< the filter resumed from a checkpoint (raised 0), or one was refused (raised 1)
  configuration = 14,     ///< a reload was taken (raised 0) or refused (raised 1, the message says why)
  input_deadline = 15,    ///< the middleware's deadline on EngineSensors was missed
  input_liveliness = 16,  ///< the writer of EngineSensors lost its liveliness
  incompatible_qos = 17,  ///< an endpoint was excluded by QoS; the message names the policy
  recording = 18,         ///< the recorder stopped or lost samples
  security = 19,          ///< somebody without permission was kept out
  source_channels = 20,   ///< a channel as its source describes it is not the design's: name, place or unit; channel:
                          ///< sensor, actuators from EHM_MAX_SENSORS on, 24 the engine's type; value: source_id
  unreadable_peer = 21,   ///< a remote endpoint of our topics that can never be read, or never read us; the message
                          ///< names participant, topic and reason (raised 0: all that were named are gone)
  source_stamps = 22,     ///< source_time_ns is not set, repeats, or steps back (value: by how many seconds, negative)
  source_sequence = 23,   ///< new samples carry the sequence number of the one before (value) and are dropped
  condition_fault = 24,   ///< channel: 0 altitude_m, 1 mach, 2 delta_isa_k, from 3 on the actuators; value: the word
                          ///< that came, threshold: the last good one
  slow_sensor = 25,       ///< channel: sensor; value: seconds between its updates, threshold: as the design has it
  held_up = 26,           ///< the monitor's process was stopped for so long (value, s) that others dropped it; it joins
                          ///< DDS anew (raised 0: it has)
  implausible = 27,  ///< channel: health parameter, estimated farther from nominal than the fleet's engines are; value
                     ///< and threshold in sigmas of the prior
  unlikely_engine = 28,  ///< the sensors together stand where no engine of the fleet does; value and threshold:
                         ///< distance from its middle, over the fleet's spread
  engine_left = 29,      ///< silent for so long (value, s) that its filter is free for another; raised 0: it is back
  second_monitor = 30,   ///< another monitor publishes under this one's source_id (value)
  command_flood = 31,    ///< resets come faster than a filter converges; those beyond one in threshold s are refused
  flight_history = 32,   ///< a baseline was not taken, or flights cannot be noted (raised 0: they are again)
  estimator_fallback =
      33,  ///< the published estimator has had no answer for so many samples (value): the watch filter's
           ///< estimates go out in its place (raised 0: it has answered so many times, and is back)
  estimator_overrun =
      34,                ///< an estimator (channel: EstimatorNumber) took longer than threshold us, three samples in a
                         ///< row (value: the latest); it rests for 10 s (raised 0: it flies again)
  estimator_chosen = 35  ///< an order has chosen whose estimates are published (channel: EstimatorNumber)
};

enum class SimCommandKind : std::uint32_t {
  set_demand = 1,    ///< value[0]: fan speed demand n1_rpm
  set_flight = 2,    ///< value: altitude_m, mach, delta_isa_k
  set_health = 3,    ///< channel, value[0]: fraction, value[1]: ramp time s (0: a step)
  add_health = 4,    ///< as set_health, relative to the present value
  sensor_fault = 5,  ///< channel, fault, value[0]: magnitude (SensorFaultKind), value[1]: duration s (0: until cleared)
  clear_faults = 6,  ///< all sensors
  set_thrust = 7     ///< value[0]: net thrust demand net_thrust_n, which the new engine would give
};

enum class SensorFaultKind : std::uint32_t {
  none = 0,
  bias = 1,     ///< magnitude: offset in the sensor's unit
  drift = 2,    ///< magnitude: unit per second
  stuck = 3,    ///< magnitude unused: holds the last value
  dropout = 4,  ///< magnitude unused: validity bit off, value NaN
  noise = 5     ///< magnitude: factor on the noise
};

enum class MonitorCommandKind : std::uint32_t {
  reset = 1,
  publish = 256  ///< to 511: publish + EstimatorNumber: that one's estimates are published from the next sample on
};

/// The estimators of the monitor's table (monitor/design/make_estimator.h), which has their names.
enum class EstimatorNumber : std::uint32_t {
  tuner = 0,
  gauss_markov = 1,
  time_varying = 2,
  onboard = 3,
  scheduled = 4,
  ekf = 5,
  iekf = 6,
  clipped_ekf = 7,
  ukf = 8,
  particle = 9,
  ekpf = 10,
  cekpf = 11,
  constrained = 12,
  map = 13,
  wls = 14,
  rls = 15
};

}  // namespace ehm::idl
