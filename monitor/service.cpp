#include "monitor/service.h"

#include <spdlog/spdlog.h>

#include <optional>

#include "deploy/service/notify.h"
#include "deploy/service/security_watch.h"
#include "deploy/service/stop_signal.h"
#include "monitor/checkpoint/checkpoint_keeper.h"
#include "monitor/cycle_thread.h"
#include "monitor/export/metrics_endpoint.h"
#include "monitor/realtime/clock.h"
#include "monitor/record/recorder.h"
#include "monitor/reporter.h"

namespace ehm::monitor {

wire::ParticipantOptions service_participant(const MonitorConfig& config) {
  wire::ParticipantOptions options;
  options.domain = static_cast<std::uint32_t>(config.domain);
  options.name = "monitor " + std::to_string(config.source_id);
  options.profiles_file = config.profiles_file;
  options.profile = config.profile;
  options.partition = config.partition;
  options.security = config.security;
  options.redundancy = {config.ownership == "exclusive", static_cast<std::uint32_t>(config.ownership_strength)};
  return options;
}

namespace {

/// What the middleware notices becomes events.
wire::ParticipantOptions watched_participant(const MonitorConfig& config, NoticeBoard& notices, InputWatch& input) {
  wire::ParticipantOptions options = service_participant(config);
  options.input = input.request();
  options.on_incompatible = [&notices](const std::string& what) {
    notices.post({wire::EventKind::incompatible_qos, true, what});
  };
  options.on_unreadable = [&notices](bool present, const std::string& what) {
    notices.post({wire::EventKind::unreadable_peer, present, what});
  };
  return options;
}

/// Checkpoints are on: what is kept in flight, and what could be resumed at start.
struct Checkpoints {
  Checkpoints(const MonitorConfig& config, const EngineTable& engines, Reporter& reporter)
      : writer(config.checkpoint_directory),
        resumable(
            config.checkpoint_directory, config.checkpoint_max_age_s, wall_clock_ns(),
            [&](std::uint32_t id) {
              const design::Design* design = engines.design_of(id);
              return design ? design->hash : std::string();
            },
            refused),
        keeper(writer, resumable, config.checkpoint_period_s, config.checkpoint_max_age_s) {
    for (const auto& r : refused)
      reporter.say({wire::EventKind::checkpoint, true, "cold start: " + r.why, r.engine_id});
  }
  std::vector<RefusedCheckpoint> refused;
  CheckpointWriter writer;
  ResumeTable resumable;
  CheckpointKeeper keeper;
};

}  // namespace

void run_service(const MonitorConfig& config, std::unique_ptr<EngineTable> table, const ReloadSource& source) {
  EngineTable& engines = *table;  // at start; the reloader owns it, and those that come after it
  const service::StopSignal stop;
  std::optional<Recorder> recorder;
  if (!config.record.file.empty()) recorder.emplace(config, engines);
  NoticeBoard notices;
  InputWatch input(notices, config.input_deadline_s, config.input_lease_s);
  auto options = watched_participant(config, notices, input);
  auto incidents = service::hear_incidents(options);
  wire::Participant participant = [&] {
    const MiddlewarePolicy inherited(config.realtime);
    return wire::Participant(std::move(options));
  }();
  auto reports = std::make_unique<ReportQueue>();
  const auto source_id = static_cast<std::uint32_t>(config.source_id);
  StatusBoard board;
  Reporter reporter(participant, source_id, *reports, notices, input, board);
  std::optional<service::SecurityWatch> security;
  if (!config.security.empty())
    security.emplace(participant, std::move(incidents), [&](const auto& text, auto times) {
      notices.post({wire::EventKind::security, true, service::incident_text(text, times)});
    });
  std::optional<Checkpoints> checkpoints;
  if (!config.checkpoint_directory.empty()) checkpoints.emplace(config, engines, reporter);
  TableExchange exchange;
  const auto know = [&](const EngineTable& next) {
    if (recorder) recorder->know(next);
  };
  const Reloader reloader(source, std::move(table), exchange, notices, {know, [&] { reporter.await_reported(); }});
  CycleThread cycle(participant, config, engines, *reports, checkpoints ? &checkpoints->keeper : nullptr,
                    recorder ? &recorder->feed() : nullptr, exchange);
  spdlog::info("monitor {} listens on domain {}, {}, filters for {} engines are ready", config.source_id, config.domain,
               service::security_text(config.security), engines.size());
  const MetricsEndpoint metrics(config.metrics_listen, source_id, board, {cycle.turns(), reporter.turns()});
  const service::Watchdog watchdog(cycle.turns(), "cycle");
  for (const std::string& warning : set_up_realtime(config.realtime)) spdlog::warn("{}", warning);
  service::notify_ready();
  while (!stop.requested()) cycle.run_once();
  service::notify_stopping();
  cycle.stop();
  spdlog::info("stopped in order");
}

}  // namespace ehm::monitor
