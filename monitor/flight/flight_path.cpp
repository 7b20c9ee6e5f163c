// SPDX-License-Identifier: Apache-2.0
#include "monitor/flight/flight_path.h"

#include <algorithm>
#include <cmath>

#include "engine_sim/model/thermo/ram.h"

namespace ehm::monitor {
namespace {

using idl::FlightPhase;

constexpr double slow_mach = 0.1, fast_mach = 0.12, power_set = 0.7, take_off_height_m = 450.0;
constexpr double moves_m_s = 2.5, level_m_s = 1.5, climb_lag_s = 10.0;
constexpr double approach_altitude_m = 3000.0, approach_mach = 0.5;
constexpr double roll_out_s = 1.0;
constexpr double metal_lag_s = 25.0;

/// sqrt(T2/288.15 K); not a number where the standard atmosphere ends.
double root_theta(const linear_model::OperatingPoint& flight) {
  return std::sqrt(engine_sim::ram_ratios(flight.altitude_m, flight.mach, flight.delta_isa_k).theta);
}

/// Share of the way that a first-order lag goes in a step.
double share(double dt_s, double lag_s) {
  return 1.0 - std::exp(-dt_s / lag_s);
}

}  // namespace

FanSpeed fan_speed_of(const linear_model::LinearModel& model) {
  for (std::size_t i = 0; i < model.sensors.size(); ++i) {
    if (model.sensors[i].unit != "rpm") continue;
    const double theta = model.operating_point ? root_theta(*model.operating_point) : 1.0;
    return {static_cast<int>(i), std::isfinite(theta) ? model.sensors[i].trim / theta : model.sensors[i].trim};
  }
  return {};
}

FlightChange FlightPath::follow(const linear_model::OperatingPoint& flight, double n1_rpm, double trim_corrected_rpm,
                                double dt_s) noexcept {
  if (!std::isfinite(flight.altitude_m) || !std::isfinite(flight.mach)) return FlightChange::none;
  follow_speed(flight, n1_rpm, dt_s);
  if (std::isfinite(altitude_m_) && dt_s > 0.0)
    climb_m_s_ += share(dt_s, climb_lag_s) * ((flight.altitude_m - altitude_m_) / dt_s - climb_m_s_);
  altitude_m_ = flight.altitude_m;
  mach_ = flight.mach;
  const double power = trim_corrected_rpm > 0.0 ? n1_corrected_rpm_ / trim_corrected_rpm : 0.0;
  switch (phase_) {
    case FlightPhase::unknown:
      return begin();
    case FlightPhase::taxi:
      return on_ground(power);
    case FlightPhase::take_off:
      return taking_off(power);
    default:
      return airborne(dt_s);
  }
}

void FlightPath::follow_speed(const linear_model::OperatingPoint& flight, double n1_rpm, double dt_s) noexcept {
  const double corrected_rpm = n1_rpm / root_theta(flight);
  if (!(corrected_rpm > 0.0) || !std::isfinite(corrected_rpm)) return;
  const double now = std::log(corrected_rpm);
  if (n1_corrected_rpm_ == 0.0) log_lagged_ = now;
  n1_corrected_rpm_ = corrected_rpm;
  log_lagged_ += share(dt_s, metal_lag_s) * (now - log_lagged_);
  eta_ = now - log_lagged_;
}

FlightChange FlightPath::begin() noexcept {
  phase_ = mach_ < slow_mach ? FlightPhase::taxi : FlightPhase::cruise;
  ground_altitude_m_ = altitude_m_;
  return in_flight() ? FlightChange::took_off : FlightChange::none;
}

FlightChange FlightPath::on_ground(double power) noexcept {
  ground_altitude_m_ = altitude_m_;
  if (mach_ <= fast_mach && power <= power_set) return FlightChange::none;
  phase_ = FlightPhase::take_off;
  slow_s_ = 0.0;
  return FlightChange::took_off;
}

FlightChange FlightPath::taking_off(double power) noexcept {
  if (altitude_m_ - ground_altitude_m_ > take_off_height_m) phase_ = FlightPhase::climb;
  if (phase_ == FlightPhase::climb || mach_ >= slow_mach || power > power_set) return FlightChange::none;
  phase_ = FlightPhase::taxi;
  return FlightChange::rejected;
}

FlightChange FlightPath::airborne(double dt_s) noexcept {
  slow_s_ = mach_ < slow_mach ? slow_s_ + dt_s : 0.0;
  if (slow_s_ >= roll_out_s) {
    phase_ = FlightPhase::taxi;
    climb_m_s_ = slow_s_ = 0.0;
    return FlightChange::landed;
  }
  if (climb_m_s_ > moves_m_s)
    phase_ = FlightPhase::climb;
  else if (altitude_m_ < approach_altitude_m && mach_ < approach_mach && climb_m_s_ < level_m_s)
    phase_ = FlightPhase::approach;
  else if (climb_m_s_ < -moves_m_s)
    phase_ = FlightPhase::descent;
  else if (std::abs(climb_m_s_) < level_m_s)
    phase_ = FlightPhase::cruise;
  return FlightChange::none;
}

}  // namespace ehm::monitor
