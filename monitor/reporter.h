#pragma once
// The slow side of the service, on its own thread: log lines, HealthEvent, MonitorStatus and EngineDescription.

#include <atomic>
#include <thread>

#include "deploy/service/watchdog.h"
#include "idl/dds/endpoint.h"
#include "idl/wire_values.h"
#include "monitor/export/status_board.h"
#include "monitor/report.h"

namespace ehm::monitor {

class Reporter {
 public:
  /// What it publishes also hangs on `board`.
  Reporter(wire::Participant& participant, std::uint32_t source_id, ReportQueue& queue, StatusBoard& board);
  /// Reports what is still queued, then ends the thread.
  ~Reporter();
  /// From any slow thread: publishes and logs what the service itself has to say. `engine_id` 0 is the whole monitor.
  void say(wire::EventKind kind, bool raised, std::uint32_t engine_id, const std::string& message);
  const service::TurnCounter& turns() const { return turns_; }

 private:
  void run();
  bool report_next();
  void report_status(const MonitorStatus& status);
  void report_new_engine(const Report& report);
  void report_event(const Report& report);
  void report_overflow();
  void publish(const HealthEvent& event);

  std::uint32_t source_id_;
  ReportQueue& queue_;
  StatusBoard& board_;
  service::TurnCounter turns_;
  std::uint64_t overflow_said_ = 0;
  wire::Writer<HealthEvent> events_;
  wire::Writer<MonitorStatus> status_;
  wire::Writer<EngineDescription> descriptions_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace ehm::monitor
