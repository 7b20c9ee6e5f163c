// SPDX-License-Identifier: Apache-2.0
#pragma once
// What is noted of one engine's flight, sample after sample, for its summary at landing: time in each phase, extremes
// of readings and estimates, what was raised. Taxi out counts to the flight that follows, taxi in to the next one.
// Real-time safe: yes. Errors: none.

#include <array>
#include <cstdint>

#include "monitor/cycle/monitor_cycle.h"
#include "monitor/flight/flight_path.h"

namespace ehm::monitor {

inline constexpr std::size_t flight_phases = 8;  ///< places for idl::FlightPhase

struct FlightTotals {
  std::uint32_t flight = 0;                   ///< number, from 1
  std::int64_t start_ns = 0, landing_ns = 0;  ///< the source's clock
  std::uint64_t samples = 0, estimated = 0;   ///< in order, since the start
  std::uint32_t events = 0, exceedances = 0;  ///< raised since the start; those of a configured limit
  std::array<double, flight_phases> phase_s{};
  std::uint32_t flags = 0;                        ///< of the latest estimates
  estimation::HealthVector health, health_sigma;  ///< the latest that held, channel units; of length 0: there was none
  estimation::SensorVector sensor_greatest;       ///< of what was fused; -infinity where nothing was
  estimation::AuxiliaryVector auxiliary_least, auxiliary_greatest;  ///< of the estimates
};

class FlightLog {
 public:
  /// After a sample that was in order. True if a flight has ended with it: finished() is that flight.
  bool follow(const MonitorCycle& cycle, const FanSpeed& fan) noexcept;
  /// So many flights of this engine are known of.
  void count_from(std::uint32_t flights) noexcept { flights_ = flights; }

  const FlightPath& path() const noexcept { return path_; }
  /// Number of the present flight, or of the latest; 0 before the first.
  std::uint32_t flight() const noexcept { return flights_; }
  const FlightTotals& finished() const noexcept { return finished_; }

 private:
  void note(const MonitorCycle& cycle, double dt_s) noexcept;
  void note_extremes(const CycleResult& result, const Sample& sample) noexcept;

  FlightPath path_;
  FlightTotals present_, finished_;
  std::uint32_t flights_ = 0;
};

}  // namespace ehm::monitor
