#include "monitor/service.h"

#include <spdlog/spdlog.h>

#include <optional>

#include "deploy/service/notify.h"
#include "deploy/service/stop_signal.h"
#include "monitor/cycle_thread.h"
#include "monitor/export/metrics_endpoint.h"
#include "monitor/reporter.h"
#include "monitor/security_events.h"

namespace ehm::monitor {

namespace {

wire::ParticipantOptions participant_options(const MonitorConfig& config) {
  wire::ParticipantOptions options;
  options.domain = static_cast<std::uint32_t>(config.domain);
  options.name = "monitor " + std::to_string(config.source_id);
  options.profiles_file = config.profiles_file;
  options.profile = config.profile;
  options.partition = config.partition;
  options.security = config.security;
  options.redundancy = {config.ownership == "exclusive", static_cast<std::uint32_t>(config.ownership_strength)};
  options.on_incompatible = [](const std::string& what) { spdlog::warn("{}", what); };
  return options;
}

}  // namespace

void run_service(const MonitorConfig& config, EngineTable& engines) {
  const service::StopSignal stop;
  auto options = participant_options(config);
  auto incidents = service::hear_incidents(options);
  wire::Participant participant(std::move(options));
  std::optional<SecurityEvents> security;
  if (!config.security.empty())
    security.emplace(participant, static_cast<std::uint32_t>(config.source_id), std::move(incidents));
  auto reports = std::make_unique<ReportQueue>();
  const auto source_id = static_cast<std::uint32_t>(config.source_id);
  StatusBoard board;
  Reporter reporter(participant, source_id, *reports, board);
  CycleThread cycle(participant, config, engines, *reports);
  spdlog::info("monitor {} listens on domain {}, filters for {} engines are ready", config.source_id, config.domain,
               engines.size());
  const MetricsEndpoint metrics(config.metrics_listen, source_id, board, {cycle.turns(), reporter.turns()});
  const service::Watchdog watchdog(cycle.turns(), "cycle");
  service::notify_ready();
  while (!stop.requested()) cycle.run_once();
  service::notify_stopping();
  cycle.say_stopped();
  spdlog::info("stopped in order");
}

}  // namespace ehm::monitor
