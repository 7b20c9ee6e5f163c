#include "monitor/service.h"

#include <spdlog/spdlog.h>

#include "deploy/service/stop_signal.h"
#include "idl/dds/middleware_log.h"
#include "monitor/cycle_thread.h"
#include "monitor/reporter.h"

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
  options.on_stranger = [](const std::string& what) { spdlog::warn("{}", what); };
  wire::hear_middleware([](const wire::MiddlewareMessage& m) { spdlog::warn("[{}] {} {}", m.category, m.error, m.text); });
  return options;
}

}  // namespace

void run_service(const MonitorConfig& config, EngineTable& engines) {
  const service::StopSignal stop;
  wire::Participant participant(participant_options(config));
  auto reports = std::make_unique<ReportQueue>();
  Reporter reporter(participant, static_cast<std::uint32_t>(config.source_id), *reports);
  CycleThread cycle(participant, config, engines, *reports);
  spdlog::info("monitor {} listens on domain {}, filters for {} engines are ready", config.source_id, config.domain,
               engines.size());
  while (!stop.requested()) cycle.run_once();
  cycle.say_stopped();
  spdlog::info("stopped in order");
}

}  // namespace ehm::monitor
