// monitor: arguments -> config -> loop -> exit code.

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <iostream>

#include "deploy/config/command_line.h"
#include "deploy/config/schema.h"
#include "deploy/service/exit_code.h"
#include "deploy/service/stop_signal.h"
#include "monitor/config.h"
#include "monitor/cycle_thread.h"
#include "monitor/engine_table.h"
#include "monitor/reporter.h"

namespace {

using namespace ehm;

wire::ParticipantOptions participant_options(const monitor::MonitorConfig& config) {
  wire::ParticipantOptions options;
  options.domain = static_cast<std::uint32_t>(config.domain);
  options.name = "monitor " + std::to_string(config.source_id);
  options.profiles_file = config.profiles_file;
  options.profile = config.profile;
  options.partition = config.partition;
  options.redundancy = {config.ownership == "exclusive", static_cast<std::uint32_t>(config.ownership_strength)};
  options.on_incompatible = [](const std::string& what) { spdlog::warn("{}", what); };
  return options;
}

void run(const monitor::MonitorConfig& config, monitor::EngineTable& engines) {
  const service::StopSignal stop;
  wire::Participant participant(participant_options(config));
  auto reports = std::make_unique<monitor::ReportQueue>();
  monitor::Reporter reporter(participant, static_cast<std::uint32_t>(config.source_id), *reports);
  monitor::CycleThread cycle(participant, config, engines, *reports);
  spdlog::info("monitor {} listens on domain {}, filters for {} engines are ready", config.source_id, config.domain,
               engines.size());
  while (!stop.requested()) cycle.run_once();
  cycle.say_stopped();
  spdlog::info("stopped in order");
}

}  // namespace

int main(int argc, char** argv) {
  spdlog::set_default_logger(spdlog::stderr_color_mt("monitor"));

  monitor::MonitorConfig config;
  config::Schema schema;
  monitor::declare(schema, config);

  config::CommandLine line;
  if (const auto code = config::parse_command_line(
          argc, argv, "monitor", "Estimates engine health from sensor samples on DDS, and publishes it.", schema, line))
    return *code;

  std::unique_ptr<monitor::EngineTable> engines;
  try {
    schema.load(line.file);
    monitor::finish_config(config);
    spdlog::set_level(spdlog::level::from_str(config.log_level));
    engines = std::make_unique<monitor::EngineTable>(config);
  } catch (const std::exception& e) {
    std::cerr << "monitor: " << e.what() << '\n';
    return service::exit_usage;
  }
  if (line.check_config) {
    std::cout << "configuration and designs are valid, filters for " << engines->size() << " engines\n";
    return service::exit_ok;
  }

  try {
    run(config, *engines);
    return service::exit_ok;
  } catch (const std::exception& e) {
    std::cerr << "monitor: " << e.what() << '\n';
    return service::exit_failed;
  }
}
