// SPDX-License-Identifier: Apache-2.0
#pragma once
// The latest that the monitor has published of each engine, for who looks from outside: metrics, health endpoint,
// systemd's status line. The reporter thread hangs up what it has just written to DDS; other threads read a copy. The
// cycle thread knows nothing of it.

#include <array>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine_health.h"
#include "idl/wire_names.h"
#include "monitor/shared/estimate_snapshot.h"

namespace ehm::monitor {

/// One estimated channel, in its unit.
struct EstimateView {
  const char* kind;  ///< "health" or "auxiliary"
  std::string channel, unit;
  double value, sigma;
};

/// What is known of one engine; of engine 0: what concerns the whole service.
struct EngineView {
  MonitorStatus status;
  std::int64_t status_ns = 0;  ///< monotonic, when that status was hung up; 0: none yet
  std::string design_hash, engine_type;
  std::vector<EstimateView> estimates;                               ///< empty while there are none
  std::vector<EstimatorFigures> estimators;                          ///< empty where the tuner filter flies alone
  std::optional<FlightSummary> flight;                               ///< the latest that has ended
  std::array<std::uint64_t, idl::event_kind_names.size()> raised{};  ///< events by kind
  /// By kind and channel, with the channel's name: is the condition raised now?
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::string, bool>> conditions;
};

using FleetView = std::map<std::uint32_t, EngineView>;  ///< by engine_id

class StatusBoard {
 public:
  /// True if the engine is new or its level has changed.
  bool post(const MonitorStatus& status);
  void post(const HealthEvent& event);
  void post(const EngineDescription& description);
  void post(const FlightSummary& summary);
  void post(std::uint32_t engine_id, const linear_model::LinearModel& model, const EstimateSnapshot& estimates);

  /// The engine is not served any more.
  void remove(std::uint32_t engine_id);

  FleetView view() const;
  /// "3 engines: 2 OK, 1 STALE"
  std::string summary() const;

 private:
  mutable std::mutex mutex_;
  FleetView engines_;
};

}  // namespace ehm::monitor
