// SPDX-License-Identifier: Apache-2.0
// fleet_watch: listens for a while to the estimates and statuses of all partitions, and prints a line for each monitor:
// engines, estimates a second, gaps in their sequence, worst p99. Exit: 0, 1 failed, 2 wrong usage

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <fastdds/dds/core/condition/WaitSet.hpp>
#include <map>

#include "deploy/runtime/config/usage_answer.h"
#include "idl/dds/endpoint.h"

namespace {

using namespace ehm;
using Clock = std::chrono::steady_clock;

struct Heard {
  std::map<std::uint32_t, std::uint64_t> sequence;  ///< latest of each engine
  std::uint64_t estimates = 0, gaps = 0;
  double p99_us = 0.0;
};

struct Options {
  idl::ParticipantOptions participant;
  double seconds = 3.0;
  std::string title;
};

std::map<std::uint32_t, Heard> listen(const Options& options) {
  idl::Participant participant(options.participant);
  idl::Reader<EngineHealth> health(participant);
  idl::Reader<MonitorStatus> status(participant);
  eprosima::fastdds::dds::WaitSet wait_set;
  eprosima::fastdds::dds::ConditionSeq triggered;
  wait_set.attach_condition(health.condition());
  std::map<std::uint32_t, Heard> monitors;
  const auto settled = Clock::now() + std::chrono::seconds(2);  // discovery, on both sides
  const auto end = settled + std::chrono::milliseconds(static_cast<int>(1e3 * options.seconds));
  while (Clock::now() < end) {
    wait_set.wait(triggered, eprosima::fastrtps::Duration_t(0.05L));
    EngineHealth estimate;
    while (health.take(estimate)) {
      if (Clock::now() < settled) continue;
      Heard& heard = monitors[estimate.source_id()];
      const auto [latest, first] = heard.sequence.try_emplace(estimate.engine_id(), estimate.sequence_number());
      if (!first) heard.gaps += estimate.sequence_number() - latest->second - 1;
      latest->second = estimate.sequence_number();
      ++heard.estimates;
    }
    MonitorStatus s;
    while (status.take(s))
      monitors[s.source_id()].p99_us = std::max(monitors[s.source_id()].p99_us, s.latency_p99_us());
  }
  return monitors;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  options.participant.name = "fleet watch";
  options.participant.partition = "fleet/*";
  CLI::App app{"Listens to all monitors of a fleet"};
  app.add_option("--profiles-file", options.participant.profiles_file, "Fast DDS XML with the profile ehm_participant");
  app.add_option("--domain", options.participant.domain, "DDS domain")->check(CLI::Range(0, 232));
  app.add_option("--partition", options.participant.partition, "DDS partition; * stands for anything");
  app.add_option("--seconds", options.seconds, "how long")->check(CLI::Range(0.1, 3600.0));
  app.add_option("--title", options.title, "printed in front of each line");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return ehm::config::usage_answer(app, e);
  }
  try {
    for (const auto& [source, heard] : listen(options))
      fmt::print("{:<28} monitor {:<5} engines {:<4} estimates/s {:<8.1f} gaps {:<5} p99 us {:.0f}\n", options.title,
                 source, heard.sequence.size(), static_cast<double>(heard.estimates) / options.seconds, heard.gaps,
                 heard.p99_us);
    return 0;
  } catch (const std::exception& e) {
    fmt::print(stderr, "fleet_watch: {}\n", e.what());
    return 1;
  }
}
