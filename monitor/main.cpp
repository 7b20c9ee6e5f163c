// SPDX-License-Identifier: Apache-2.0
// monitor: arguments -> config -> loop -> exit code; with --listen a wiring check instead of the loop; monitor history
// ENGINE: what has been noted of an engine.

#include <spdlog/spdlog.h>

#include <algorithm>
#include <iostream>

#include "deploy/runtime/config/command_line.h"
#include "deploy/runtime/config/schema.h"
#include "deploy/runtime/files/atomic_file.h"
#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/service/exit_code.h"
#include "deploy/runtime/service/ignored_signals.h"
#include "deploy/runtime/service/log.h"
#include "deploy/runtime/service/reload_signal.h"
#include "deploy/runtime/service/written.h"
#include "idl/dds/descriptors.h"
#include "idl/dds/security.h"
#include "monitor/checkpoint/checkpoint_folder.h"
#include "monitor/history/history_command.h"
#include "monitor/listen/listen.h"
#include "monitor/service/config.h"
#include "monitor/service/offline.h"
#include "monitor/service/service.h"
#include "monitor/shared/engine_table.h"

namespace {

/// What a reload reads: the same file, environment and command line, as they are then.
ehm::monitor::LoadedConfig read_again(int argc, char** argv) {
  using namespace ehm;
  monitor::LoadedConfig loaded;
  config::Schema schema;
  monitor::declare(schema, loaded.config);
  monitor::ListenOptions ignored;
  config::CommandLine line;
  line.more_options = [&ignored](CLI::App& app) { monitor::declare(app, ignored); };
  config::parse_command_line(argc, argv, "monitor", "", schema, line);
  schema.load(line.file);
  monitor::finish_config(loaded.config);
  loaded.values = schema.values();
  return loaded;
}

int run(int argc, char** argv) {
  using namespace ehm;
  if (const auto code = monitor::run_command(argc, argv, std::cout, std::cerr)) return *code;
  service::ignore_fatal_signals();
  const service::ReloadSignal early;  // a SIGHUP from now on is remembered, and ends nobody
  service::start_log("monitor");

  monitor::MonitorConfig config;
  config::Schema schema;
  monitor::declare(schema, config);

  monitor::ListenOptions listen;
  config::CommandLine line;
  line.more_options = [&listen](CLI::App& app) { monitor::declare(app, listen); };
  CLI::App commands;
  monitor::add_history_command(commands);
  const std::string purpose = std::string("Estimates engine health from sensor samples on DDS, and publishes it.\n") +
                              monitor::history_command_help;
  if (const auto code = config::parse_command_line(argc, argv, "monitor", purpose, schema, line, &commands))
    return *code;

  std::unique_ptr<monitor::EngineTable> engines;
  try {
    schema.load(line.file);
    monitor::finish_config(config);
    idl::check_security(config.security);
    idl::check_profile(monitor::service_participant(config));
    idl::require_descriptors();
    spdlog::set_level(spdlog::level::from_str(config.log_level));
    // The flight goes on without what cannot be written; whoever only checks wants to know of it.
    if (line.check_config && !config.checkpoint_directory.empty())
      monitor::require_writable_folder(config.checkpoint_directory, "checkpoint.directory");
    if (line.check_config && !config.history.directory.empty())
      monitor::require_writable_folder(config.history.directory, "history.directory");
    if (line.check_config && !config.record.file.empty()) const files::AtomicFile probe(config.record.file);
    if (!config.offline.file.empty()) {
      const std::vector<std::string> given = schema.given();
      monitor::choose_offline_estimator(config, std::ranges::count(given, "estimator.published") > 0);
      monitor::choose_all_estimators(config);
    }
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
    if (listen.wanted)
      return monitor::listen(config, *engines, listen, std::cout) ? service::exit_ok : service::exit_failed;
    if (config.offline.file.empty())
      monitor::run_service(config, std::move(engines), {schema.values(), [=] { return read_again(argc, argv); }});
    else
      monitor::run_offline(config, *engines);
    return service::exit_ok;
  } catch (const files::FileError& e) {
    std::cerr << "monitor: " << e.what() << '\n';
    return service::exit_usage;
  } catch (const config::ConfigError& e) {
    std::cerr << "monitor: " << e.what() << '\n';
    return service::exit_usage;
  } catch (const std::exception& e) {
    std::cerr << "monitor: " << e.what() << '\n';
    return service::exit_failed;
  }
}

}  // namespace

int main(int argc, char** argv) {
  return ehm::service::written(run(argc, argv), std::cout, std::cerr, "monitor");
}
