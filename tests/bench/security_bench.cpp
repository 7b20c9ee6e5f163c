// SPDX-License-Identifier: Apache-2.0
// What DDS Security costs: EngineSensors to a second process and EngineResiduals back, without security, signed and
// encrypted, in one run, in short alternating blocks. Certificates are made by the script that users run.
// Usage: security_bench [--rounds N] [--pings N] [--pause-us N] [--domain D]

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fastdds/dds/core/condition/WaitSet.hpp>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include "deploy/runtime/config/usage_answer.h"
#include "idl/dds/endpoint.h"
#include "idl/wire_values.h"
#include "tests/temporary_folder.h"

namespace {

using namespace ehm;
using Clock = std::chrono::steady_clock;
using eprosima::fastrtps::Duration_t;

constexpr std::array<const char*, 3> kinds{"plain", "sign", "encrypt"};

struct Options {
  int rounds = 30, pings = 100, pause_us = 1000;
  std::uint32_t domain = 48;  // and the two after it
};

idl::ParticipantOptions participant_options(const Options& options, std::size_t kind, const std::string& files,
                                            const std::string& role) {
  idl::ParticipantOptions o;
  o.domain = options.domain + static_cast<std::uint32_t>(kind);
  o.name = std::string("security_bench ") + role;
  if (kind > 0) o.security = files + "/" + kinds[kind] + "/" + role;
  return o;
}

/// The other process: answers each sample at once.
class Echo {
 public:
  explicit Echo(const idl::ParticipantOptions& options)
      : participant_(options), sensors_(participant_), answers_(participant_) {}
  eprosima::fastdds::dds::StatusCondition& condition() { return sensors_.condition(); }
  void answer() {
    while (sensors_.take(sample_)) {
      answer_.engine_id(sample_.engine_id());
      answer_.sequence_number(sample_.sequence_number());
      answers_.write(answer_);
    }
  }

 private:
  idl::Participant participant_;
  idl::Reader<EngineSensors> sensors_;
  idl::Writer<EngineResiduals> answers_;
  EngineSensors sample_;
  EngineResiduals answer_;
};

[[noreturn]] void run_echo(const Options& options, const std::string& files) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  eprosima::fastdds::dds::WaitSet wait_set;
  eprosima::fastdds::dds::ConditionSeq triggered;
  std::vector<std::unique_ptr<Echo>> echoes;
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    echoes.push_back(std::make_unique<Echo>(participant_options(options, kind, files, "monitor")));
    wait_set.attach_condition(echoes.back()->condition());
  }
  for (;;) {
    wait_set.wait(triggered, Duration_t(1, 0));
    for (auto& echo : echoes) echo->answer();
  }
}

class Ping {
 public:
  explicit Ping(const idl::ParticipantOptions& options)
      : participant_(options), sensors_(participant_), answers_(participant_) {
    wait_set_.attach_condition(answers_.condition());
    sample_.engine_id(1);
    sample_.schema(idl::schema_version);
  }
  bool matched() const { return sensors_.matched() == 1 && answers_.matched() == 1; }
  /// Round trip in us; negative if no answer came within a second.
  double round_trip_us() {
    sample_.sequence_number(sample_.sequence_number() + 1);
    const auto start = Clock::now();
    sensors_.write(sample_);
    while (Clock::now() - start < std::chrono::seconds(1)) {
      wait_set_.wait(triggered_, Duration_t(1, 0));
      while (answers_.take(answer_))
        if (answer_.sequence_number() == sample_.sequence_number())
          return std::chrono::duration<double, std::micro>(Clock::now() - start).count();
    }
    return -1.0;
  }

 private:
  idl::Participant participant_;
  idl::Writer<EngineSensors> sensors_;
  idl::Reader<EngineResiduals> answers_;
  eprosima::fastdds::dds::WaitSet wait_set_;
  eprosima::fastdds::dds::ConditionSeq triggered_;
  EngineSensors sample_;
  EngineResiduals answer_;
};

double quantile(std::vector<double> values, double q) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// False when somebody never answered.
bool measure(const Options& options, const std::string& files) {
  std::vector<std::unique_ptr<Ping>> pings;
  for (std::size_t kind = 0; kind < kinds.size(); ++kind)
    pings.push_back(std::make_unique<Ping>(participant_options(options, kind, files, "sensor_source")));
  const auto deadline = Clock::now() + std::chrono::seconds(20);
  for (auto& ping : pings)
    while (!ping->matched() || ping->round_trip_us() < 0.0)
      if (Clock::now() > deadline) return false;

  std::array<std::vector<double>, kinds.size()> times;
  for (int round = 0; round < options.rounds; ++round)
    for (std::size_t kind = 0; kind < kinds.size(); ++kind)
      for (int i = 0; i < options.pings; ++i) {
        std::this_thread::sleep_for(std::chrono::microseconds(options.pause_us));
        if (const double us = pings[kind]->round_trip_us(); us >= 0.0) times[kind].push_back(us);
      }
  std::printf("%-8s %8s %10s %10s %12s %12s\n", "", "answers", "p50 us", "p99 us", "p50 - plain", "p99 - plain");
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    if (times[kind].empty()) return false;
    std::printf("%-8s %8zu %10.1f %10.1f %12.1f %12.1f\n", kinds[kind], times[kind].size(), quantile(times[kind], 0.5),
                quantile(times[kind], 0.99), quantile(times[kind], 0.5) - quantile(times[0], 0.5),
                quantile(times[kind], 0.99) - quantile(times[0], 0.99));
  }
  return true;
}

int run(const Options& options) {
  const ehm::test::TemporaryFolder files;  // the keys go with it
  for (const char* kind : {kinds[1], kinds[2]}) {
    const std::string make = std::string(EHM_SOURCE_DIR "/deploy/security/make_security.sh --out ") + files.path(kind) +
                             " --protection " + kind + " >/dev/null";
    if (std::system(make.c_str()) != 0) throw std::runtime_error("make_security.sh failed, see above");
  }
  const pid_t echo = fork();  // before any DDS: threads do not survive a fork
  if (echo == 0) run_echo(options, files.path());
  const bool measured = measure(options, files.path());
  kill(echo, SIGKILL);
  waitpid(echo, nullptr, 0);
  if (!measured) std::fprintf(stderr, "security_bench: the other process does not answer\n");
  return measured ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{"Round trip without security, signed, encrypted"};
  app.add_option("--rounds", options.rounds)->check(CLI::Range(1, 100000))->capture_default_str();
  app.add_option("--pings", options.pings, "a block")->check(CLI::Range(1, 100000))->capture_default_str();
  app.add_option("--pause-us", options.pause_us, "between pings")->check(CLI::Range(0, 100000))->capture_default_str();
  app.add_option("--domain", options.domain, "and the two after it")->check(CLI::Range(0, 228))->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return ehm::config::usage_answer(app, e);
  }

  try {
    return run(options);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "security_bench: %s\n", e.what());
    return 1;
  }
}
