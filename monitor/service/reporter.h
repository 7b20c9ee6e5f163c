// SPDX-License-Identifier: Apache-2.0
#pragma once
// The slow side of the service, on its own thread: log lines, HealthEvent, MonitorStatus and EngineDescription.

#include <atomic>
#include <set>
#include <thread>

#include "deploy/runtime/service/watchdog.h"
#include "idl/dds/endpoint.h"
#include "idl/wire_values.h"
#include "monitor/dds/input_watch.h"
#include "monitor/export/status_board.h"
#include "monitor/history/flight_keeper.h"
#include "monitor/shared/cycle_report.h"
#include "monitor/shared/notice_board.h"

namespace ehm::monitor {

class Reporter {
 public:
  /// What it publishes also hangs on `board`; `turns` grows with each look at the queue.
  Reporter(idl::Participant& participant, std::uint32_t source_id, CycleReportQueue& queue, NoticeBoard& notices,
           FlightBoard& flights, InputWatch& input, StatusBoard& board, service::TurnCounter& turns);
  /// Reports what is still queued, then ends the thread.
  ~Reporter();
  /// From a slow thread: returns once everything that was queued before the call is reported, by this reporter or one
  /// that follows it. `turns`: of these reporters.
  static void await_reported(const service::TurnCounter& turns);

 private:
  void run();
  bool report_next();
  void report_new_engine(const CycleReport& report);
  void report_left(const CycleReport& report);
  void report_reply(const CycleReport& report);
  void report_event(const CycleReport& report);
  void report_source_channel(const CycleReport& report);
  void report_notices();
  void report_status(MonitorStatus& status);
  void report_overflow();
  void report_flight(const SummedFlight& summed);
  void say(const Notice& notice);
  void publish(HealthEvent& event);

  idl::UnreadablePeers& unreadable_;
  std::int64_t unreadable_told_ns_ = 0;
  std::uint32_t source_id_;
  CycleReportQueue& queue_;
  NoticeBoard& notices_;
  FlightBoard& flights_;
  InputWatch& input_;
  StatusBoard& board_;
  service::TurnCounter& turns_;
  std::uint64_t overflow_said_ = 0;
  idl::Writer<HealthEvent> events_;
  idl::Writer<MonitorStatus> status_;
  idl::Writer<EngineDescription> descriptions_;
  idl::Writer<FlightSummary> summaries_;
  idl::Writer<CommandReply> replies_;
  std::int64_t refusal_told_ns_ = 0;
  std::uint64_t refusals_ = 0;    ///< orders refused since then
  std::set<std::uint32_t> left_;  ///< engines that have left and not come back
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace ehm::monitor
