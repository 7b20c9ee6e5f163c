// SPDX-License-Identifier: Apache-2.0
#pragma once
// Where an engine is in its flight, by what air data and its fan speed say:
//
//   N1c = N1 / sqrt(T2 / 288.15 K),   T2 = T0 (1 + 0.2 M^2),   T0: ISA + delta
//   eta = ln N1c - lag(ln N1c, 25 s)          how far the metal is from its balance (theory.md, section 13)
//   climb rate: of the altitude, lagged by 10 s
//
//   taxi      M < 0.1 on the ground
//   take_off  from the ground: M > 0.12, or N1c above 70 % of its trim; until 450 m higher
//   climb, cruise, descent   climb rate above 2.5, below 1.5 and above -1.5, below -2.5 m/s; between: as before
//   approach  no climb, below 3000 m and M < 0.5
//   landed    M < 0.1 for a second after one of these: taxi
//
// A take-off that ends as taxi without having climbed was rejected: no flight. Whoever is first heard of in the air has
// taken off. Errors: none; words that are no number are as those before. Real-time safe: yes.

#include <cstdint>
#include <limits>

#include "engine_sim/linear_model/linear_model.h"
#include "idl/wire_values.h"

namespace ehm::monitor {

/// The fan speed of a design: which sensor, and its corrected trim; -1 where no sensor is in rpm.
struct FanSpeed {
  int sensor = -1;
  double trim_corrected_rpm = 0.0;
};
/// The first sensor in rpm. Not real-time safe.
FanSpeed fan_speed_of(const linear_model::LinearModel& model);

enum class FlightChange { none, took_off, rejected, landed };

class FlightPath {
 public:
  /// One sample, `dt_s` after the one before. `n1_rpm`: not a number where it was not measured.
  FlightChange follow(const linear_model::OperatingPoint& flight, double n1_rpm, double trim_corrected_rpm,
                      double dt_s) noexcept;

  idl::FlightPhase phase() const noexcept { return phase_; }
  bool in_flight() const noexcept { return phase_ >= idl::FlightPhase::take_off; }
  /// 0 until a fan speed was measured.
  double n1_corrected_rpm() const noexcept { return n1_corrected_rpm_; }
  double eta() const noexcept { return eta_; }

 private:
  void follow_speed(const linear_model::OperatingPoint& flight, double n1_rpm, double dt_s) noexcept;
  FlightChange begin() noexcept;
  FlightChange on_ground(double power) noexcept;
  FlightChange taking_off(double power) noexcept;
  FlightChange airborne(double dt_s) noexcept;

  idl::FlightPhase phase_ = idl::FlightPhase::unknown;
  double altitude_m_ = std::numeric_limits<double>::quiet_NaN(), mach_ = 0.0;
  double climb_m_s_ = 0.0, ground_altitude_m_ = 0.0, slow_s_ = 0.0;
  double n1_corrected_rpm_ = 0.0, log_lagged_ = 0.0, eta_ = 0.0;
};

}  // namespace ehm::monitor
