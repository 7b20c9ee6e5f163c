// SPDX-License-Identifier: Apache-2.0
#pragma once
// The real-time side of the service: takes each sample as it arrives, runs its engine's cycle, writes the estimates,
// and watches for input that stays away. EngineHealth is written first, and the latency ends there: from the reception
// of the sample by the middleware to its EngineHealth handed to the middleware. Logs, events and status go to the
// reporter through a bounded queue.

#include <deque>
#include <fastdds/dds/core/condition/WaitSet.hpp>

#include "deploy/runtime/service/watchdog.h"
#include "idl/dds/endpoint.h"
#include "monitor/checkpoint/checkpoint_keeper.h"
#include "monitor/dds/convert.h"
#include "monitor/dds/source_descriptions.h"
#include "monitor/dds/waiting_room.h"
#include "monitor/history/flight_keeper.h"
#include "monitor/realtime/arrival_clock.h"
#include "monitor/record/record_feed.h"
#include "monitor/redundancy/peer_watch.h"
#include "monitor/redundancy/ranked_writer.h"
#include "monitor/reload/table_exchange.h"
#include "monitor/service/shadow_writers.h"
#include "monitor/shared/cycle_report.h"
#include "monitor/shared/engine_table.h"

namespace ehm::monitor {

/// What the cycle gives to other threads, and takes from them. It outlives the thread's endpoints.
struct CycleLinks {
  CycleReportQueue& reports;
  CheckpointKeeper* checkpoints;  ///< null: none are kept
  FlightKeeper& flights;
  RecordFeed* records;  ///< null: nothing is recorded
  TableExchange& exchange;
  service::TurnCounter& turns;  ///< grows with every turn and every sample, at least 60 times a second
  std::int64_t start_ns;        ///< of the service, monotonic
};

class CycleThread {
 public:
  CycleThread(idl::Participant& participant, const MonitorConfig& config, EngineTable& engines,
              const CycleLinks& links);

  /// Waits for input, 15 ms at most, and handles what has come. Call until the service stops.
  void run_once();
  /// Ends in order: leaves every engine between two of its samples, tells its subscribers, keeps a last checkpoint.
  void stop();
  /// The table that flies at present.
  EngineTable& engines() { return *engines_; }

 private:
  void hear_descriptions();
  void take_samples();
  bool must_wait(const Arrival& arrival);
  void handle(const Arrival& arrival);
  void keep_budget(EngineSlot& slot);
  void fit_source(EngineSlot& slot, std::uint64_t participant);
  void report_misfits(const EngineSlot& slot, DescribedSource& source);
  void report_channel(const EngineSlot& slot, const SourceChannel& channel);
  void publish(EngineSlot& slot, std::int64_t arrival_ns);
  void publish_shadows(EngineSlot& slot, const Stamp& stamp);
  /// False if this monitor must not write now.
  template <class T>
  bool send(EngineSlot& slot, RankedWriter<T>& writer, const T& sample);
  EngineSlot* admit(const EngineSensors& sensors);
  void obey(const MonitorCommand& command);
  OrderOutcome::Kind carry_out(const MonitorCommand& command, OrderOutcome& outcome);
  bool reset(EngineSlot& slot);
  OrderOutcome::Kind choose(std::string_view estimator, EngineSlot& slot);
  void watch_input(std::int64_t now_ns);
  void check_recording(EngineSlot& slot);
  void first_sample(EngineSlot& slot);
  void leave(EngineSlot& slot, double age_s);
  bool incumbent() const { return peers_ && peers_->incumbent(); }
  void exchange_table();
  void release(EngineSlot& slot);
  void release_all();
  static bool between_samples(const EngineSlot& slot, std::int64_t now_ns);
  void report_event(const EngineSlot& slot, const Event& event);
  void report_events(EngineSlot& slot);
  void report_malformed(EngineSlot& slot);
  void report_status(EngineSlot& slot, idl::StatusLevel level, std::int64_t now_ns);

  std::uint32_t source_id_;
  bool source_clock_;
  std::int64_t status_period_ns_;
  double forget_engine_s_;
  std::int64_t start_ns_;
  EngineTable* engines_;  ///< exchanged at a reload, between two turns
  TableExchange& exchange_;
  CycleReportQueue& reports_;
  CheckpointKeeper* checkpoints_;
  FlightKeeper& flights_;
  RecordFeed* records_;
  std::uint64_t unknown_engine_samples_ = 0;
  ArrivalClock arrival_;
  bool backlog_ = false;  ///< the last turn left samples
  std::int64_t watched_ns_ = 0;
  service::TurnCounter& turns_;

  idl::Reader<EngineSensors> sensors_;
  idl::Reader<MonitorCommand> commands_;
  SourceDescriptions descriptions_;
  RankedWriter<EngineHealth> health_;
  RankedWriter<EngineAuxiliary> auxiliary_;
  RankedWriter<EngineResiduals> residuals_;
  std::deque<ShadowWriters> shadows_;  ///< in the order of all_shadow_names
  bool leaving_ = false;               ///< engines are to be released
  eprosima::fastdds::dds::WaitSet wait_set_;
  eprosima::fastdds::dds::ConditionSeq triggered_;

  Arrival incoming_;
  WaitingRoom waiting_;  ///< for their sources' descriptions
  Sample stray_;         ///< of an engine that has no filter
  EngineHealth health_sample_;
  EngineAuxiliary auxiliary_sample_;
  EngineResiduals residuals_sample_;
  std::unique_ptr<PeerWatch> peers_;  ///< null unless ownership is exclusive
};

}  // namespace ehm::monitor
