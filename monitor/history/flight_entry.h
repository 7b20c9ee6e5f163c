// SPDX-License-Identifier: Apache-2.0
#pragma once
// One line of an engine's history: a flight as its summary has it, or what was done to the engine on the ground.
//
// As text: one JSON object a line, schema "ehm-flight/1", channels by name in their units, phases in seconds, margins
// only where the published estimator has an engine model.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "monitor/flight/flight_log.h"

namespace ehm::monitor {

inline constexpr const char* flight_schema = "ehm-flight/1";

struct FlightMargins {
  double egt_k = 0.0, egt_sigma_k = 0.0;
  double thrust = 0.0, thrust_sigma = 0.0;  ///< shares of the take-off thrust
};

struct Flight {
  std::uint32_t number = 0;
  std::int64_t start_ns = 0, landing_ns = 0;  ///< the source's clock
  std::string design_hash;
  std::uint64_t samples = 0, estimated = 0;
  std::uint32_t flags = 0, events = 0, exceedances = 0;
  std::uint32_t flights_learned = 0;  ///< in the baseline that wear is counted from
  std::array<double, flight_phases> phase_s{};
  struct Health {
    std::string name, unit;
    double value = 0.0, sigma = 0.0, wear = 0.0;
  };
  struct Extreme {
    std::string name, unit;
    double least = 0.0, greatest = 0.0;  ///< of a sensor both are the greatest
  };
  std::vector<Health> health;  ///< empty: there was no estimate
  std::vector<Extreme> sensors, auxiliary;
  std::optional<FlightMargins> margins;
};

/// What was done to the engine between two flights. `wash`: its health may have changed by a percent or two; after a
/// `replacement` of parts nothing is known of it.
struct Maintenance {
  enum class Kind { wash, replacement };
  Kind kind = Kind::wash;
  std::int64_t time_ns = 0;
  std::string note;
};

struct HistoryEntry {
  std::optional<Flight> flight;  ///< one of the two is there
  std::optional<Maintenance> maintenance;
};

const char* name_of(Maintenance::Kind kind);

std::string to_line(const Flight& flight);
std::string to_line(const Maintenance& maintenance);

/// `where` (file and line) is only named in messages.
/// @throws files::FileError (where, key, value, allowed) if the line is no such object.
HistoryEntry parse_line(std::string_view line, const std::string& where);

}  // namespace ehm::monitor
