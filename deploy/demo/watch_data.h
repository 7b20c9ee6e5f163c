#pragma once
// What ehm_watch has heard on the wire about one engine: latest values, truth and estimate paired by sequence number,
// and the counts of its summary.

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine_health.h"
#include "monitor/realtime/latency_histogram.h"

namespace ehm::demo {

struct Row {
  std::string name, unit;
  double truth = 0.0, estimate = 0.0, sigma = 0.0;
  /// |estimate - truth| in sigmas; infinite where that is no number.
  double deviation() const;
};

struct EventLine {
  double time_s = 0.0;  ///< since the first sample
  bool raised = false;
  std::uint32_t kind = 0;
  std::string channel, message;
  double value = 0.0;
};

class WatchData {
 public:
  void hear(const EngineTruth& truth);
  void hear(const EngineHealth& health);
  void hear(const EngineAuxiliary& auxiliary);
  void hear(const EngineDescription& description);
  void hear(const MonitorStatus& status);
  void hear(const HealthEvent& event);

  /// Truth beside the latest estimate; empty until both and their description are there.
  std::vector<Row> health() const;
  std::vector<Row> auxiliary() const;
  /// The latest ones, `most_events` at most: a watch may run for weeks beside a sensor that chatters.
  const std::deque<EventLine>& events() const { return events_; }
  static constexpr std::size_t most_events = 1000;
  /// Earlier ones that were let go.
  std::uint64_t events_dropped() const { return events_dropped_; }
  const std::optional<MonitorStatus>& status() const { return status_; }
  const monitor::LatencyHistogram& latency() const { return latency_; }

  /// Time of the flight that the latest estimate belongs to.
  double flight_time_s() const;
  std::uint64_t estimates() const { return estimates_; }
  /// Samples that the simulator sent, by the number of the last one.
  std::uint64_t published() const { return last_truth_ ? last_truth_->sequence_number() + 1 : 0; }
  std::uint64_t received() const { return status_ ? status_->samples_received() : 0; }
  /// The monitor has accounted for the last sample that was sent.
  bool accounted() const { return status_ && status_->last_sequence() + 1 == published(); }
  /// What the monitor counted, and once it has accounted for all, what never reached it at the start or the end.
  std::uint64_t lost() const;

 private:
  const EngineTruth* truth_of(std::uint64_t sequence) const;

  // Truth waits here for its estimate: a second of samples, by sequence number modulo the size.
  std::array<std::optional<EngineTruth>, 64> recent_truth_;
  std::optional<EngineTruth> last_truth_;
  std::optional<EngineHealth> health_;
  std::optional<EngineAuxiliary> auxiliary_;
  std::optional<EngineDescription> description_;
  std::optional<MonitorStatus> status_;
  std::optional<std::int64_t> first_time_ns_;
  std::deque<EventLine> events_;
  std::uint64_t events_dropped_ = 0;
  monitor::LatencyHistogram latency_;
  std::uint64_t estimates_ = 0;
};

}  // namespace ehm::demo
