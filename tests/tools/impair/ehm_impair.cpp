// SPDX-License-Identifier: Apache-2.0
// ehm_impair: takes EngineSensors on one domain and publishes them on another, as a bad network would deliver them.
// Prints its counters as one JSON object at the end (SIGINT, SIGTERM, --duration-s) and on the line "status".

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <chrono>
#include <fastdds/dds/core/condition/WaitSet.hpp>
#include <iostream>
#include <nlohmann/json.hpp>

#include "deploy/runtime/config/usage_answer.h"
#include "deploy/runtime/service/exit_code.h"
#include "deploy/runtime/service/stop_signal.h"
#include "idl/dds/endpoint.h"
#include "tests/tools/impair/control.h"
#include "tests/tools/line_input.h"

namespace {

using namespace ehm;
using namespace ehm::test;

struct Options {
  std::uint32_t from = 0, to = 1;
  std::string from_partition, to_partition, schedule;
  std::uint64_t seed = 1;
  int wait_for_readers = 0;
  double duration_s = 0.0;
  ImpairmentSettings settings;
};

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

idl::ParticipantOptions participant(std::uint32_t domain, const std::string& partition) {
  idl::ParticipantOptions options;
  options.domain = domain;
  options.name = "ehm_impair";
  options.partition = partition;
  options.on_incompatible = [](const std::string& what) { std::cerr << "ehm_impair: " << what << '\n'; };
  return options;
}

std::string json(const Impairment& impairment) {
  const auto& c = impairment.counters();
  return nlohmann::json{{"received", c.received},         {"sent", c.sent},           {"dropped", c.dropped},
                        {"duplicated", c.duplicated},     {"held_back", c.held_back}, {"set_nan", c.set_nan},
                        {"bits_flipped", c.bits_flipped}, {"restamped", c.restamped}, {"pending", impairment.pending()}}
      .dump();
}

std::string flag(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  return "--" + name;
}

/// One turn of the way from reader to writer: what has come is received, what is due is sent.
void carry(idl::Reader<EngineSensors>& reader, idl::Writer<EngineSensors>& writer, Impairment& impairment) {
  EngineSensors sample;
  while (reader.take(sample)) impairment.receive(sample, now_s());
  while (const auto due = impairment.send(now_s())) writer.write(*due);
}

void obey_input(LineInput& input, Impairment& impairment) {
  while (const auto line = input.next()) {
    if (*line == "status") {
      std::cout << json(impairment) << std::endl;
      continue;
    }
    try {
      obey(*line, now_s(), impairment);
    } catch (const std::invalid_argument& e) {
      std::cerr << "ehm_impair: " << e.what() << '\n';
    }
  }
}

void run(const Options& options, Schedule schedule) {
  constexpr double longest_wait_s = 0.005;
  const service::StopSignal stop;
  idl::Participant in(participant(options.from, options.from_partition));
  idl::Participant out(participant(options.to, options.to_partition));
  idl::Writer<EngineSensors> writer(out);
  eprosima::fastdds::dds::ConditionSeq triggered;
  const timespec moment{0, 10'000'000};
  while (!stop.requested() && writer.matched() < options.wait_for_readers) nanosleep(&moment, nullptr);

  idl::Reader<EngineSensors> reader(in);
  eprosima::fastdds::dds::WaitSet wait_set;
  wait_set.attach_condition(reader.condition());
  Impairment impairment(options.seed);
  impairment.settings = options.settings;
  LineInput input;
  const double start_s = now_s();
  double first_s = 0.0;
  while (!stop.requested() && (options.duration_s <= 0.0 || now_s() - start_s < options.duration_s)) {
    const double wait_s = impairment.next_due_s().value_or(now_s() + longest_wait_s) - now_s();
    wait_set.wait(triggered,
                  eprosima::fastrtps::Duration_t(static_cast<long double>(std::clamp(wait_s, 0.0001, longest_wait_s))));
    carry(reader, writer, impairment);
    obey_input(input, impairment);
    if (impairment.counters().received > 0 && first_s == 0.0) first_s = now_s();
    if (first_s > 0.0) schedule.run(now_s() - first_s, now_s(), impairment);
  }
  writer.drain(0.5);
  std::cout << json(impairment) << std::endl;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{
      "Takes EngineSensors on one domain and publishes them on another, as a bad network would deliver them.\n"
      "Lines on standard input change it while it runs: 'loss 0.2', 'pause 2' (hold 2 s, then send at once),\n"
      "'cut 2' (drop for 2 s), 'clear 0', 'status'. Not for run.rate = \"max\", which waits for answers.\n" +
      std::string(service::exit_code_help)};
  app.add_option("--from", options.from, "domain to take from")->check(CLI::Range(0, 232))->capture_default_str();
  app.add_option("--to", options.to, "domain to publish on")->check(CLI::Range(0, 232))->capture_default_str();
  app.add_option("--from-partition", options.from_partition, "DDS partition to take from");
  app.add_option("--to-partition", options.to_partition, "DDS partition to publish in");
  app.add_option("--wait-for-readers", options.wait_for_readers, "take nothing before so many readers have matched")
      ->check(CLI::Range(0, 1000));
  app.add_option("--seed", options.seed, "of the generator")->capture_default_str();
  app.add_option("--duration-s", options.duration_s, "end after so long; 0: at SIGINT or SIGTERM")
      ->check(CLI::Range(0.0, 1e9));
  app.add_option("--schedule", options.schedule, "file of lines 'SECONDS NAME VALUE', from the first sample on");
  for (const auto& setting : setting_names())
    app.add_option(flag(setting.name), options.settings.*setting.value, setting.description)
        ->check(CLI::Range(setting.min, setting.max))
        ->capture_default_str();
  Schedule schedule;
  try {
    app.parse(argc, argv);
    if (options.from == options.to && options.from_partition == options.to_partition)
      throw std::invalid_argument("--from and --to are the same domain and partition; samples would go round in it");
    if (!options.schedule.empty()) schedule = Schedule(options.schedule);
  } catch (const CLI::ParseError& e) {
    return config::usage_answer(app, e);
  } catch (const std::exception& e) {
    std::cerr << "ehm_impair: " << e.what() << '\n';
    return service::exit_usage;
  }
  try {
    run(options, std::move(schedule));
    return service::exit_ok;
  } catch (const std::exception& e) {
    std::cerr << "ehm_impair: " << e.what() << '\n';
    return service::exit_failed;
  }
}
