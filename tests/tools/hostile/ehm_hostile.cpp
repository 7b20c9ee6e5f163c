// SPDX-License-Identifier: Apache-2.0
// ehm_hostile: floods a domain with bad sensor samples, descriptions and commands, at a stated rate, from a seed. It
// spoils the samples of the real source when it hears one, so that everything but one thing is plausible.
// Prints what it sent, by kind, as one JSON object at the end.

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <array>
#include <chrono>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "deploy/runtime/config/usage_answer.h"
#include "deploy/runtime/service/exit_code.h"
#include "deploy/runtime/service/stop_signal.h"
#include "idl/dds/endpoint.h"
#include "idl/wire_values.h"
#include "tests/tools/hostile/attack.h"

namespace {

using namespace ehm;
using namespace ehm::test;
using Clock = std::chrono::steady_clock;

struct Options {
  std::uint32_t domain = 0, engine = 1, source_id = 666;
  std::string partition;
  double rate_hz = 200.0, duration_s = 10.0;
  std::uint64_t seed = 1;
  std::vector<std::string> kinds;
  int wait_for_readers = 1;
};

/// What a JT9D-like source might send, until a real one is heard.
EngineSensors stranger(const Options& options) {
  EngineSensors s;
  s.engine_id(options.engine);
  s.schema(idl::schema_version);
  s.altitude_m(10668.0);
  s.mach(0.8);
  s.sensor_count(7);
  s.sensor_valid(0x7f);
  s.actuator_count(5);
  s.sensor().fill(500.0);
  return s;
}

class Flood {
 public:
  Flood(idl::Participant& participant, const Options& options, std::vector<Attack> attacks)
      : options_(options),
        attacks_(std::move(attacks)),
        random_(options.seed),
        latest_(stranger(options)),
        heard_(participant),
        samples_(participant),
        commands_(participant),
        descriptions_(participant) {}

  int matched() const { return samples_.matched(); }

  void send_one() {
    for (EngineSensors s; heard_.take(s);)
      if (s.engine_id() == options_.engine && s.source_id() != options_.source_id) latest_ = s;
    const Attack attack = attacks_[random_() % attacks_.size()];
    ++sent_[static_cast<std::size_t>(attack)];
    switch (attack) {
      case Attack::command:
        commands_.write(bad_command(options_.engine, random_));
        return;
      case Attack::reset:
        commands_.write(reset_command(options_.engine));
        return;
      case Attack::text:
        descriptions_.write(bad_description(options_.engine, options_.source_id, random_));
        return;
      default:
        send_sample(attack);
    }
  }

  std::string json() const {
    nlohmann::json sent;
    std::uint64_t total = 0;
    for (const auto& known : attack_names()) {
      sent[known.name] = sent_[static_cast<std::size_t>(known.attack)];
      total += sent_[static_cast<std::size_t>(known.attack)];
    }
    sent["total"] = total;
    return sent.dump();
  }

 private:
  void send_sample(Attack attack) {
    EngineSensors bad = latest_;
    bad.source_id(options_.source_id);
    spoil(bad, attack, random_);
    samples_.write(bad);
  }

  Options options_;
  std::vector<Attack> attacks_;
  std::mt19937_64 random_;
  EngineSensors latest_;
  idl::Reader<EngineSensors> heard_;
  idl::Writer<EngineSensors> samples_;
  idl::Writer<MonitorCommand> commands_;
  idl::Writer<EngineDescription> descriptions_;
  std::array<std::uint64_t, 12> sent_{};
};

void run(const Options& options, std::vector<Attack> attacks) {
  const service::StopSignal stop;
  idl::ParticipantOptions participant_options;
  participant_options.domain = options.domain;
  participant_options.name = "ehm_hostile";
  participant_options.partition = options.partition;
  idl::Participant participant(participant_options);
  Flood flood(participant, options, std::move(attacks));
  // Its own reader is one of those that match.
  while (!stop.requested() && flood.matched() < options.wait_for_readers + 1)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const auto period = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1.0 / options.rate_hz));
  const auto end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options.duration_s));
  auto next = Clock::now();
  while (!stop.requested() && (options.duration_s <= 0.0 || Clock::now() < end)) {
    flood.send_one();
    next = std::max(next + period, Clock::now() - std::chrono::seconds(1));
    std::this_thread::sleep_until(next);
  }
  std::cout << flood.json() << std::endl;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  std::string kinds;
  for (const auto& known : attack_names()) kinds += std::string(kinds.empty() ? "" : ", ") + known.name;
  CLI::App app{"Floods a domain with bad sensor samples, descriptions and commands.\n" +
               std::string(service::exit_code_help)};
  app.add_option("--domain", options.domain, "DDS domain")->check(CLI::Range(0, 232))->capture_default_str();
  app.add_option("--partition", options.partition, "DDS partition");
  app.add_option("--engine", options.engine, "engine_id to attack")->capture_default_str();
  app.add_option("--source-id", options.source_id, "source_id to pretend")->capture_default_str();
  app.add_option("--rate-hz", options.rate_hz, "samples a second")->check(CLI::Range(0.1, 1e5))->capture_default_str();
  app.add_option("--duration-s", options.duration_s, "0: until SIGINT or SIGTERM")
      ->check(CLI::Range(0.0, 1e9))
      ->capture_default_str();
  app.add_option("--seed", options.seed, "of the generator")->capture_default_str();
  app.add_option("--kinds", options.kinds, "which of: " + kinds + "; by default all but text and reset")
      ->delimiter(',');
  app.add_option("--wait-for-readers", options.wait_for_readers, "send nothing before so many have matched")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  std::vector<Attack> attacks;
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return config::usage_answer(app, e);
  }
  for (const auto& name : options.kinds) {
    const auto attack = attack_of(name);
    if (!attack) {
      std::cerr << "ehm_hostile: --kinds '" << name << "', allowed are " << kinds << '\n';
      return service::exit_usage;
    }
    attacks.push_back(*attack);
  }
  if (attacks.empty())
    for (const auto& known : attack_names())
      if (known.by_default) attacks.push_back(known.attack);
  try {
    run(options, std::move(attacks));
    return service::exit_ok;
  } catch (const std::exception& e) {
    std::cerr << "ehm_hostile: " << e.what() << '\n';
    return service::exit_failed;
  }
}
