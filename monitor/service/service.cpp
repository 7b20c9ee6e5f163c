// SPDX-License-Identifier: Apache-2.0
#include "monitor/service/service.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <atomic>
#include <functional>
#include <mutex>
#include <optional>

#include "deploy/runtime/service/notify.h"
#include "deploy/runtime/service/security_watch.h"
#include "deploy/runtime/service/stop_deadline.h"
#include "idl/dds/security_files.h"
#include "monitor/checkpoint/checkpoint_keeper.h"
#include "monitor/design/make_estimator.h"
#include "monitor/export/metrics_endpoint.h"
#include "monitor/history/flight_keeper.h"
#include "monitor/realtime/clock.h"
#include "monitor/record/recorder.h"
#include "monitor/service/cycle_thread.h"
#include "monitor/service/reporter.h"
#include "monitor/shared/engine_estimators.h"

namespace ehm::monitor {

idl::ParticipantOptions service_participant(const MonitorConfig& config) {
  idl::ParticipantOptions options;
  options.domain = static_cast<std::uint32_t>(config.domain);
  options.name = "monitor " + std::to_string(config.source_id);
  if (!config.partition.empty()) options.name += " of " + config.partition;
  options.profiles_file = config.profiles_file;
  options.profile = config.profile;
  options.partition = config.partition;
  options.security = config.security;
  options.redundancy = {config.ownership == "exclusive", static_cast<std::uint32_t>(config.ownership_strength)};
  return options;
}

namespace {

/// What the middleware notices becomes events.
idl::ParticipantOptions watched_participant(const MonitorConfig& config, NoticeBoard& notices, InputWatch& input) {
  idl::ParticipantOptions options = service_participant(config);
  options.input = input.request();
  options.on_incompatible = [&notices](const std::string& what) {
    notices.post({.kind = idl::EventKind::incompatible_qos, .raised = true, .text = what});
  };
  options.on_namesake = [&notices, source_id = config.source_id](bool present) {
    notices.post(
        {.kind = idl::EventKind::second_monitor,
         .raised = present,
         .text = present
                     ? fmt::format("another monitor of this domain has monitor.source_id = {} too: give each its own",
                                   source_id)
                     : fmt::format("no other monitor has monitor.source_id = {} any more", source_id),
         .value = static_cast<double>(source_id)});
  };
  options.on_unreadable = [&notices](bool present, const std::string& what) {
    notices.post({.kind = idl::EventKind::unreadable_peer, .raised = present, .text = what});
  };
  return options;
}

/// Checkpoints are on: what is kept in flight, and what could be resumed at start.
struct Checkpoints {
  Checkpoints(const MonitorConfig& config, const EngineTable& engines, NoticeBoard& notices)
      : writer(config.checkpoint_directory, notices, most_companions(config)),
        resumable(
            config.checkpoint_directory, config.checkpoint_max_age_s, wall_clock_ns(),
            [&](std::uint32_t id) {
              const design::Design* design = engines.design_of(id);
              return design ? design->hash : std::string();
            },
            refused),
        keeper(writer, resumable, config.checkpoint_period_s, config.checkpoint_max_age_s, most_companions(config)) {
    for (const auto& r : refused)
      notices.post({.kind = idl::EventKind::checkpoint,
                    .raised = true,
                    .text = "cold start: " + r.why,
                    .engine_id = r.engine_id});
  }
  std::vector<RefusedCheckpoint> refused;
  CheckpointWriter writer;
  ResumeTable resumable;
  CheckpointKeeper keeper;
};

/// What the threads share; it outlives the participant, which is made anew when this process was held up.
struct Shared {
  explicit Shared(const MonitorConfig& config) : input(notices, config.input_deadline_s, config.input_lease_s) {}
  NoticeBoard notices;
  InputWatch input;
  FlightBoard flights;
  StatusBoard board;
  std::unique_ptr<CycleReportQueue> reports = std::make_unique<CycleReportQueue>();
  TableExchange exchange;
  std::mutex identity_mutex;
  idl::IdentityFacts identity;  ///< of the participant that is there
  std::atomic<std::int64_t> certificate_expires_s{0};
  std::atomic<bool> identity_changed{false};  ///< its files are others since, valid ones
  service::TurnCounter cycle_turns, reporter_turns;
};

/// Why a participant is given up.
struct Parting {
  double held_up_s = 0.0;  ///< so long that others may have dropped it
  bool new_identity = false;
  bool stop() const { return held_up_s == 0.0 && !new_identity; }
};

/// Takes part in DDS with all that hangs on a participant, from `entered` on until it is to end, or has to be made
/// anew. `engines` is the table that flies, before and after.
Parting take_part(const MonitorConfig& config, EngineTable*& engines, Shared& shared, const CycleLinks& links,
                  const service::StopSignal& stop, const std::function<void(const RealtimeThread&)>& entered) {
  shared.identity_changed = false;
  idl::IdentityFacts identity;
  if (!config.security.empty()) identity = idl::examine_identity(config.security);
  {
    const std::lock_guard lock(shared.identity_mutex);
    shared.identity = identity;
    shared.certificate_expires_s = identity.expires_s;
  }
  auto options = watched_participant(config, shared.notices, shared.input);
  auto incidents = service::receive_incidents(options);
  idl::Participant participant = [&] {
    const MiddlewarePolicy inherited(config.realtime);
    return idl::Participant(std::move(options));
  }();
  Reporter reporter(participant, static_cast<std::uint32_t>(config.source_id), *shared.reports, shared.notices,
                    shared.flights, shared.input, shared.board, shared.reporter_turns);
  std::optional<service::SecurityWatch> security;
  if (!config.security.empty())
    security.emplace(
        participant, std::move(incidents),
        [&](const auto& text, auto times) {
          shared.notices.post(
              {.kind = idl::EventKind::security, .raised = true, .text = service::incident_text(text, times)});
        },
        identity.expires_s);
  CycleThread cycle(participant, config, *engines, links);
  const RealtimeThread realtime(config.realtime);
  entered(realtime);
  Parting parting;
  while (!stop.requested() && parting.stop()) {
    cycle.run_once();
    parting = {participant.held_up_s(), shared.identity_changed.load(std::memory_order_relaxed)};
  }
  if (stop.requested()) {
    parting = {};
    service::notify_stopping();
    cycle.stop();
  }
  engines = &cycle.engines();
  return parting;
}

/// At a reload: takes the files of the identity as they are now, if they are others and valid. Throws what is wrong.
void look_at_identity(const MonitorConfig& config, Shared& shared) {
  const idl::IdentityFacts now = idl::examine_identity(config.security);
  const std::lock_guard lock(shared.identity_mutex);
  if (now.fingerprint != shared.identity.fingerprint) shared.identity_changed = true;
}

}  // namespace

void run_service(const MonitorConfig& config, std::unique_ptr<EngineTable> table, const ReloadSource& source) {
  EngineTable* engines = table.get();  // at start; the reloader owns it, and those that come after it
  const service::StopSignal stop;
  const service::StopDeadline deadline;
  Shared shared(config);
  std::optional<Recorder> recorder;
  if (!config.record.file.empty()) recorder.emplace(config, *engines, shared.notices);
  std::optional<Checkpoints> checkpoints;
  if (!config.checkpoint_directory.empty()) checkpoints.emplace(config, *engines, shared.notices);
  FlightKeeper flights(config, *engines, shared.notices, shared.flights);
  const auto know = [&](const EngineTable& next) {
    flights.add_designs(next);
    if (recorder) recorder->add_engines(next);
    if (!config.security.empty()) look_at_identity(config, shared);
  };
  const Reloader reloader(source, std::move(table), shared.exchange, shared.notices,
                          {know, [&] { Reporter::await_reported(shared.reporter_turns); }});
  const MetricsEndpoint metrics(
      config.metrics_listen, static_cast<std::uint32_t>(config.source_id), shared.board,
      {shared.cycle_turns, shared.reporter_turns, config.status_period_s, shared.certificate_expires_s});
  const service::Watchdog watchdog({{&shared.cycle_turns, "cycle"}, {&shared.reporter_turns, "reporter"}});
  const CycleLinks links{*shared.reports, checkpoints ? &checkpoints->keeper : nullptr,
                         flights,         recorder ? &recorder->feed() : nullptr,
                         shared.exchange, shared.cycle_turns,
                         monotonic_ns()};
  Parting parting = take_part(config, engines, shared, links, stop, [&](const RealtimeThread& realtime) {
    spdlog::info("monitor {} listens on domain {}, {}, filters for {} engines are ready", config.source_id,
                 config.domain, service::security_text(config.security), engines->size());
    for (const std::string& warning : realtime.warnings()) spdlog::warn("{}", warning);
    service::notify_ready();
  });
  while (!parting.stop()) {
    const auto say = [&](bool raised, const std::string& text) {
      shared.notices.post({.kind = parting.new_identity ? idl::EventKind::security : idl::EventKind::held_up,
                           .raised = raised,
                           .text = text,
                           .value = parting.held_up_s});
    };
    say(true, parting.new_identity
                  ? "certificates, permissions or revocations have changed: joining DDS anew with the new ones"
                  : fmt::format("held up for {:.1f} s (stopped, or the machine suspended): other participants have "
                                "dropped us, joining DDS anew",
                                parting.held_up_s));
    parting = take_part(config, engines, shared, links, stop,
                        [&](const RealtimeThread&) { say(false, "has joined DDS anew"); });
  }
  service::StopDeadline::in_order();
  spdlog::info("stopped in order");
}

}  // namespace ehm::monitor
