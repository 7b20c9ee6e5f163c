// SPDX-License-Identifier: Apache-2.0
#include "monitor/listen/listen.h"

#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <fastdds/dds/core/condition/WaitSet.hpp>
#include <mutex>
#include <ostream>
#include <set>

#include "deploy/runtime/service/stop_signal.h"
#include "idl/dds/endpoint.h"
#include "monitor/dds/input_watch.h"
#include "monitor/listen/listen_report.h"
#include "monitor/service/service.h"

namespace ehm::monitor {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds misfit_period{400};  // between looks at messages that are not of the type
constexpr double patience_s = 3.0;  // beside --seconds, for endpoints to match and the first sample to come

/// What the middleware says on its own threads.
class Complaints {
 public:
  void add(const std::string& text) {
    const std::lock_guard lock(mutex_);
    texts_.insert(text);
  }
  std::set<std::string> all() const {
    const std::lock_guard lock(mutex_);
    return texts_;
  }
  bool about(const std::string& topic) const {
    const auto texts = all();
    return std::any_of(texts.begin(), texts.end(),
                       [&](const std::string& text) { return text.starts_with("topic " + topic + ":"); });
  }

 private:
  mutable std::mutex mutex_;
  std::set<std::string> texts_;
};

using Descriptions = std::map<SourceKey, EngineDescription>;

void hear_descriptions(idl::Reader<EngineDescription>& reader, Descriptions& descriptions) {
  EngineDescription d;
  while (reader.take(d))
    if (d.role() == static_cast<std::uint32_t>(idl::DescriptionRole::source))
      descriptions[{d.engine_id(), d.source_id()}] = d;
}

void check_wiring(ListenReport& report, const Descriptions& descriptions, const EngineTable& engines,
                  const CycleOptions& options) {
  for (auto& [key, source] : report.sources) {
    source.design = engines.design_of(key.first);
    if (!source.design) {
      source.wiring.findings.push_back(
          {true, "no design serves this engine; name it in an [[engine]] table or set monitor.design"});
      continue;
    }
    const auto described = descriptions.find(key);
    source.wiring = check_wiring(source.record, *source.design, options,
                                 described != descriptions.end() ? &described->second : nullptr);
  }
}

void check_whole(ListenReport& report, const MonitorConfig& config, int writers, const Complaints& complaints) {
  for (const std::string& text : complaints.all()) report.findings.push_back({true, text});
  std::uint32_t last_engine = 0;
  for (const auto& [key, source] : report.sources) {
    if (key.first == last_engine)
      report.findings.push_back(
          {false, fmt::format("engine {} has several sources; the monitor follows the first until it falls silent",
                              key.first)});
    last_engine = key.first;
  }
  if (!report.sources.empty() || complaints.about("EngineSensors")) return;  // who is kept out is known already
  const std::string place = fmt::format("domain {}, partition '{}'", config.domain, config.partition);
  report.findings.push_back(
      {true, writers == 0 ? "no writer of EngineSensors on " + place +
                                ": check domain, partition, network interface, multicast and firewall of both sides"
                          : "a writer of EngineSensors is there on " + place + ", but no sample came"});
}

}  // namespace

void declare(CLI::App& app, ListenOptions& options) {
  auto* listen = app.add_flag("--listen", options.wanted,
                              "do not estimate: verify what arrives on EngineSensors against the design, and exit 0 if "
                              "it is wired right");
  app.add_option("--seconds", options.seconds, "how long --listen listens, from the first sample on; 0 until Ctrl-C")
      ->check(CLI::Range(0.0, 1e6))
      ->needs(listen)
      ->capture_default_str();
  app.add_flag("--json", options.json, "report of --listen as JSON")->needs(listen);
}

bool listen(const MonitorConfig& config, const EngineTable& engines, const ListenOptions& options, std::ostream& out) {
  const service::StopSignal stop;
  Complaints complaints;
  idl::ParticipantOptions participant_options = service_participant(config);
  participant_options.name += " --listen";
  NoticeBoard unheard;
  InputWatch input(unheard, config.input_deadline_s, config.input_lease_s);
  participant_options.input = input.request();  // as the service asks for it
  participant_options.on_incompatible = [&](const std::string& what) { complaints.add(what); };
  participant_options.on_unreadable = [&](bool present, const std::string& what) {
    if (present) complaints.add(what);
  };
  idl::Participant participant(participant_options);
  idl::Reader<EngineSensors> sensors(participant);
  idl::Reader<EngineDescription> descriptions(participant);
  eprosima::fastdds::dds::WaitSet wait_set;
  eprosima::fastdds::dds::ConditionSeq triggered;
  wait_set.attach_condition(sensors.condition());

  ListenReport report;
  Descriptions described;
  EngineSensors sample;
  int writers = 0;
  auto start = Clock::now(), told = start;
  double limit_s = options.seconds + patience_s;
  while (!stop.requested() && (options.seconds == 0.0 || report.seconds < limit_s)) {
    wait_set.wait(triggered, eprosima::fastrtps::Duration_t(0.05L));
    while (sensors.take(sample)) {
      if (report.sources.empty()) {
        start = Clock::now();
        limit_s = options.seconds;
      }
      report.sources[{sample.engine_id(), sample.source_id()}].record.hear(sample, sensors.received_ns());
    }
    hear_descriptions(descriptions, described);
    if (Clock::now() - told >= misfit_period) {
      told = Clock::now();
      participant.unreadable().tell();
    }
    writers = std::max(writers, sensors.matched());
    report.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  }
  check_wiring(report, described, engines, config.cycle);
  check_whole(report, config, writers, complaints);
  out << (options.json ? report_json(report) : report_text(report)) << std::flush;
  return report.good();
}

}  // namespace ehm::monitor
