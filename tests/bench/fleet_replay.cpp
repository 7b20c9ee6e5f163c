// SPDX-License-Identifier: Apache-2.0
// fleet_replay: EngineSensors of many engines from one light process, each engine every period, spread evenly over it.
// No physics: every engine stays at the design's trim. Prints one line of JSON when it ends.
//
// Exit: 0 done, 1 failed, 2 wrong usage

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <vector>

#include "deploy/runtime/config/usage_answer.h"
#include "deploy/runtime/service/stop_signal.h"
#include "engine_sim/dds/wait_for_readers.h"
#include "engine_sim/pacer.h"
#include "idl/dds/endpoint.h"
#include "tests/bench/trim_sample.h"

namespace {

using namespace ehm;

struct Options {
  std::string design, partition, profiles_file;
  std::uint32_t domain = 0, engines = 1, first_id = 1;
  double seconds = 10.0, period_ms = 15.0;
  int readers = 1;
};

int run(const Options& options) {
  const service::StopSignal stop;
  spdlog::set_level(spdlog::level::warn);  // standard output is for the line of JSON
  idl::ParticipantOptions participant_options;
  participant_options.domain = options.domain;
  participant_options.name = "fleet replay";
  participant_options.partition = options.partition;
  participant_options.profiles_file = options.profiles_file;
  idl::Participant participant(participant_options);
  idl::Writer<EngineSensors> writer(participant);
  engine_sim::wait_for_readers(
      options.readers, [&] { return writer.matched() >= options.readers; }, stop);
  if (stop.requested()) return 0;

  const tuner_design::TrimSample trim(options.design);
  std::vector<tuner_design::TrimSample> engines;
  for (std::uint32_t i = 0; i < options.engines; ++i) engines.push_back(trim.of_engine(options.first_id + i));
  const auto period_ns = static_cast<std::int64_t>(1e6 * options.period_ms);
  const auto rounds = static_cast<std::uint64_t>(1e3 * options.seconds / options.period_ms);
  engine_sim::Pacer pacer(1e-3 * options.period_ms / options.engines);
  std::uint64_t sent = 0, refused = 0;
  for (std::uint64_t round = 0; round < rounds && !stop.requested(); ++round)
    for (auto& engine : engines) {
      if (stop.requested()) break;  // a writer without readers may wait at each sample
      refused += !writer.write(engine.next(period_ns));
      ++sent;
      pacer.wait();
    }
  writer.drain(2.0);
  fmt::print("{{\"sent\": {}, \"refused\": {}, \"worst_lateness_ms\": {:.2f}}}\n", sent, refused,
             1e-6 * static_cast<double>(pacer.worst_ns()));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{"EngineSensors of many engines from one light process"};
  app.add_option("--design", options.design, "design file: channels and trim")->required()->check(CLI::ExistingFile);
  app.add_option("--domain", options.domain, "DDS domain")->check(CLI::Range(0, 232));
  app.add_option("--partition", options.partition, "DDS partition");
  app.add_option("--profiles-file", options.profiles_file, "Fast DDS XML with the profile ehm_participant");
  app.add_option("--engines", options.engines, "how many")->check(CLI::Range(1, 100000));
  app.add_option("--first-id", options.first_id, "engine_id of the first")->check(CLI::PositiveNumber);
  app.add_option("--seconds", options.seconds, "how long")->check(CLI::Range(0.1, 86400.0));
  app.add_option("--period-ms", options.period_ms, "of each engine")->check(CLI::Range(1.0, 1000.0));
  app.add_option("--readers", options.readers, "begins when so many listen")->check(CLI::Range(0, 100));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return ehm::config::usage_answer(app, e);
  }
  try {
    return run(options);
  } catch (const std::exception& e) {
    fmt::print(stderr, "fleet_replay: {}\n", e.what());
    return 1;
  }
}
