// SPDX-License-Identifier: Apache-2.0
// The soak's eyes and hands on DDS: says as JSON lines what it sees, and turns lines of its input into commands.
//
// Every line out has "what" (second, event, status, gap, restart, description), "t" (seconds of source time flown so
// far, also across restarts of the source) and "wall" (monotonic seconds). A "second" line sums up one second of
// source time. Orders: tests/soak/order.h.

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <iostream>
#include <nlohmann/json.hpp>

#include "deploy/runtime/config/usage_answer.h"
#include "deploy/runtime/service/exit_code.h"
#include "idl/dds/endpoint.h"
#include "monitor/realtime/clock.h"
#include "tests/soak/error_watch.h"
#include "tests/soak/order.h"

namespace {

using namespace ehm;
using Json = nlohmann::json;

constexpr std::uint32_t whole_service = 0;  ///< engine_id of events that concern no single engine
constexpr std::uint32_t simulator_id = 1;   ///< engine.source_id of engine_sim, by default

/// Source time flown, over gaps and restarts of the source.
class FlownTime {
 public:
  void hear(std::int64_t source_time_ns) {
    const double dt_s = last_ns_ == 0 ? 0.0 : 1e-9 * static_cast<double>(source_time_ns - last_ns_);
    if (dt_s > 0.0 && dt_s < longest_step_s) flown_s_ += dt_s;
    last_ns_ = source_time_ns;
  }
  double seconds() const { return flown_s_; }
  /// How long before the latest sample, in source time; 0 for a stamp of another life of the source.
  double since(std::int64_t source_time_ns) const {
    const double ago_s = 1e-9 * static_cast<double>(last_ns_ - source_time_ns);
    return ago_s > 0.0 && ago_s < longest_step_s ? ago_s : 0.0;
  }

 private:
  static constexpr double longest_step_s = 60.0;
  std::int64_t last_ns_ = 0;
  double flown_s_ = 0.0;
};

class Agent {
 public:
  Agent(idl::Participant& source_side, idl::Participant& monitor_side, std::uint32_t engine_id)
      : engine_id_(engine_id),
        sensors_(source_side),
        truth_(source_side),
        sim_commands_(source_side),
        health_(monitor_side),
        auxiliary_(monitor_side),
        residuals_(monitor_side),
        descriptions_(monitor_side),
        status_(monitor_side),
        events_(monitor_side),
        monitor_commands_(monitor_side) {}

  void hear_all() {
    each(sensors_, [&](const EngineSensors& s) {
      if (s.source_id() == simulator_id) hear(s);  // others only disturb
    });
    each(truth_, [&](const EngineTruth& t) { errors_.hear(t); });
    each(health_, [&](const EngineHealth& h) {
      errors_.hear(h);
      ++estimates_;
      flags_ |= h.flags();
    });
    each(auxiliary_, [&](const EngineAuxiliary& z) { errors_.hear(z); });
    each(residuals_, [&](const EngineResiduals& r) { hear(r); });
    each(descriptions_, [&](const EngineDescription& d) { hear(d); });
    each(status_, [&](const MonitorStatus& s) { hear(s); });
    each(events_, [&](const HealthEvent& e) { hear(e); });
  }
  /// False on quit.
  bool obey(const std::string& line) {
    const auto order = soak::read_order(line, engine_id_);
    if (!order) {
      std::cerr << "soak_agent: not understood: " << line << '\n';
      return true;
    }
    if (const auto* c = std::get_if<SimCommand>(&*order)) sim_commands_.write(*c);
    if (const auto* c = std::get_if<MonitorCommand>(&*order)) monitor_commands_.write(*c);
    return !std::holds_alternative<soak::Quit>(*order);
  }

 private:
  template <class T, class Visit>
  void each(idl::Reader<T>& reader, Visit&& visit) {
    T sample;
    while (reader.take(sample))
      if (sample.engine_id() == engine_id_ || sample.engine_id() == whole_service) visit(sample);
  }
  void say(const char* what, Json line) {
    line["what"] = what;
    line["t"] = flown_.seconds();
    line["wall"] = 1e-9 * static_cast<double>(monitor::monotonic_ns());
    std::cout << line.dump(-1, ' ', false, Json::error_handler_t::replace) << std::endl;
  }

  void hear(const EngineSensors& s) {
    if (sent_total_ > 0 && s.sequence_number() <= last_sent_) say("restart", {{"last", last_sent_}});
    last_sent_ = s.sequence_number();
    ++sent_total_;
    flown_.hear(s.source_time_ns());
    if (flown_.seconds() < next_second_) return;
    next_second_ = std::floor(flown_.seconds()) + 1.0;
    say("second", {{"sent", sent_total_},
                   {"answered", answered_},
                   {"estimates", estimates_},
                   {"flags", flags_},
                   {"health", block(errors_.health)},
                   {"auxiliary", block(errors_.auxiliary)}});
    flags_ = 0;
    errors_.health = errors_.auxiliary = {};
  }
  static Json block(const soak::ErrorBlock& b) {
    return {{"values", b.values}, {"within_3", b.within_3}, {"worst", b.worst}, {"channel", b.channel}};
  }
  void hear(const EngineResiduals& r) {
    if (answered_ > 0 && r.sequence_number() > last_answered_ + 1)
      say("gap", {{"from", last_answered_ + 1}, {"to", r.sequence_number() - 1}});
    if (answered_ > 0 && r.sequence_number() == last_answered_) say("double", {{"sequence", r.sequence_number()}});
    last_answered_ = r.sequence_number();
    ++answered_;
  }
  void hear(const EngineDescription& d) {
    Json sensors = Json::array(), health = Json::array(), auxiliary = Json::array();
    for (std::size_t i = 0; i < d.sensor_count(); ++i)
      sensors.push_back({{"name", d.sensors()[i].name().c_str()}, {"sigma", d.sensors()[i].sigma()}});
    for (std::size_t i = 0; i < d.health_count(); ++i) health.push_back(d.health()[i].name().c_str());
    for (std::size_t i = 0; i < d.auxiliary_count(); ++i) auxiliary.push_back(d.auxiliary()[i].name().c_str());
    say("description", {{"sensors", sensors}, {"health", health}, {"auxiliary", auxiliary}});
  }
  void hear(const MonitorStatus& s) {
    say("status", {{"source", s.source_id()},
                   {"level", s.level()},
                   {"last_sequence", s.last_sequence()},
                   {"received", s.samples_received()},
                   {"processed", s.samples_processed()},
                   {"lost", s.samples_lost()},
                   {"duplicated", s.samples_duplicated()},
                   {"reordered", s.samples_reordered()},
                   {"foreign", s.samples_foreign()},
                   {"malformed", s.samples_malformed()},
                   {"withheld", s.samples_withheld()},
                   {"restarts", s.filter_restarts()},
                   {"deadline_misses", s.deadline_misses()},
                   {"latency_p50_us", s.latency_p50_us()},
                   {"latency_p99_us", s.latency_p99_us()},
                   {"latency_p999_us", s.latency_p999_us()},
                   {"latency_max_us", s.latency_max_us()},
                   {"writes_refused", s.writes_refused()},
                   {"reports_lost", s.reports_lost()},
                   {"checkpoints_written", s.checkpoints_written()},
                   {"reloads", s.reloads()},
                   {"reloads_refused", s.reloads_refused()}});
  }
  void hear(const HealthEvent& e) {
    const double ago_s = flown_.since(e.source_time_ns());
    say("event", {{"ago_s", ago_s},
                  {"source", e.source_id()},
                  {"kind", e.kind()},
                  {"channel", e.channel()},
                  {"raised", e.raised() != 0},
                  {"sequence", e.sequence_number()},
                  {"value", e.value()},
                  {"name", e.channel_name().c_str()},
                  {"message", e.message().c_str()}});
  }

  std::uint32_t engine_id_;
  idl::Reader<EngineSensors> sensors_;
  idl::Reader<EngineTruth> truth_;
  idl::Writer<SimCommand> sim_commands_;
  idl::Reader<EngineHealth> health_;
  idl::Reader<EngineAuxiliary> auxiliary_;
  idl::Reader<EngineResiduals> residuals_;
  idl::Reader<EngineDescription> descriptions_;
  idl::Reader<MonitorStatus> status_;
  idl::Reader<HealthEvent> events_;
  idl::Writer<MonitorCommand> monitor_commands_;

  FlownTime flown_;
  soak::ErrorWatch errors_;
  std::uint64_t sent_total_ = 0, last_sent_ = 0, answered_ = 0, last_answered_ = 0, estimates_ = 0;
  std::uint32_t flags_ = 0;
  double next_second_ = 0.0;
};

idl::ParticipantOptions options_of(std::uint32_t domain) {
  idl::ParticipantOptions options;
  options.domain = domain;
  options.name = "soak_agent";
  return options;
}

/// Looks at DDS every few milliseconds and at the input whenever there is a line; ends on quit or at end of input.
void serve(Agent& agent) {
  constexpr int look_ms = 5;
  fcntl(STDIN_FILENO, F_SETFL, fcntl(STDIN_FILENO, F_GETFL) | O_NONBLOCK);
  std::string pending;
  for (;;) {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    poll(&input, 1, look_ms);
    char buffer[4096];
    const ssize_t got = input.revents != 0 ? read(STDIN_FILENO, buffer, sizeof buffer) : -1;
    if (got == 0) return;
    if (got > 0) pending.append(buffer, static_cast<std::size_t>(got));
    for (auto end = pending.find('\n'); end != std::string::npos; end = pending.find('\n')) {
      if (!agent.obey(pending.substr(0, end))) return;
      pending.erase(0, end + 1);
    }
    agent.hear_all();
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::uint32_t source_domain = 0, monitor_domain = 0, engine = 1;
  CLI::App app{"The soak's eyes and hands on DDS; tests/soak/soak.sh drives it."};
  app.add_option("--source-domain", source_domain, "DDS domain of the simulator")
      ->check(CLI::Range(0, 232))
      ->required();
  app.add_option("--monitor-domain", monitor_domain, "DDS domain of the monitor")
      ->check(CLI::Range(0, 232))
      ->required();
  app.add_option("--engine", engine, "engine_id")->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return config::usage_answer(app, e);
  }
  try {
    idl::Participant source_side(options_of(source_domain)), monitor_side(options_of(monitor_domain));
    Agent agent(source_side, monitor_side, engine);
    serve(agent);
    return service::exit_ok;
  } catch (const std::exception& e) {
    std::cerr << "soak_agent: " << e.what() << '\n';
    return service::exit_failed;
  }
}
