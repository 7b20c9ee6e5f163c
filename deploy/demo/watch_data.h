// SPDX-License-Identifier: Apache-2.0
#pragma once
// What ehm_watch has heard on the wire about one engine: latest values, truth and estimate paired by sample, and the
// counts of its summary. Without truth, as on hardware, the estimates stand alone.

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "deploy/demo/truth_sources.h"
#include "engine_health.h"

namespace ehm::demo {

struct Row {
  std::string name, unit;
  std::optional<double> truth;
  double estimate = 0.0, sigma = 0.0;
  /// |estimate - truth| in sigmas; infinite where that is no number, nothing without truth.
  std::optional<double> deviation() const;
};

struct EventLine {
  double time_s = 0.0;  ///< since the first estimate
  bool raised = false;
  std::uint32_t kind = 0;
  std::string channel, message;
  double value = 0.0;
};

class WatchData {
 public:
  /// `participant`: of the writer, Reader::participant.
  void hear(const EngineTruth& truth, std::uint64_t participant) { truth_.hear(truth, participant); }
  void hear(const EngineDescription& description, std::uint64_t participant);
  void hear(const EngineHealth& health);
  void hear(const EngineAuxiliary& auxiliary) { auxiliary_ = auxiliary; }
  void hear(const MonitorStatus& status);
  void hear(const HealthEvent& event);

  /// The latest estimate, beside its truth if that was heard; empty until both it and its description are there.
  std::vector<Row> health() const;
  std::vector<Row> auxiliary() const;
  /// Names of the sensors in the design that flies, and of those that are left out of it.
  std::vector<std::string> sensors(bool used) const;
  /// Names of the flags that the latest estimate bears.
  std::vector<std::string> flags() const;
  /// The latest ones, `most_events` at most: a watch may run for weeks beside a sensor that chatters.
  const std::deque<EventLine>& events() const { return events_; }
  static constexpr std::size_t most_events = 1000;
  /// Earlier ones that were let go.
  std::uint64_t events_dropped() const { return events_dropped_; }
  /// Of the monitor whose estimates are shown, or of any while there are none; nullptr before the first.
  const MonitorStatus* status() const;
  const TruthSources& truth() const { return truth_; }

  /// Time of the flight that the latest estimate belongs to.
  double flight_time_s() const;
  std::uint64_t estimates() const { return estimates_; }
  /// Samples that the source sent, by the number of its last truth; 0 where there is no truth.
  std::uint64_t published() const { return truth_.last() ? truth_.last()->sequence_number() + 1 : 0; }
  std::uint64_t received() const { return status() ? status()->samples_received() : 0; }
  /// The monitor has accounted for the last sample that was sent.
  bool accounted() const { return status() && published() > 0 && status()->last_sequence() + 1 == published(); }
  /// What the monitor counted meanwhile; once it has accounted for all that was sent, also what never reached it.
  std::uint64_t lost() const;
  /// Samples that came meanwhile, and of which no honest estimate was possible.
  std::uint64_t withheld() const;
  /// Has the monitor said ERROR meanwhile?
  bool error_said() const { return watched() && watched()->error_said; }

 private:
  /// One monitor; what it counted before we listened is not ours to judge.
  struct Watched {
    MonitorStatus first, last;
    bool error_said = false;
  };
  const Watched* watched() const;

  TruthSources truth_;
  std::optional<EngineHealth> health_;
  std::optional<EngineAuxiliary> auxiliary_;
  std::optional<EngineDescription> description_;
  std::map<std::uint32_t, Watched> monitors_;  ///< by source_id
  std::uint32_t last_monitor_ = 0;
  std::optional<std::int64_t> first_time_ns_;
  std::uint64_t first_sequence_ = 0;
  std::deque<EventLine> events_;
  std::uint64_t events_dropped_ = 0;
  std::uint64_t estimates_ = 0;
};

}  // namespace ehm::demo
