// SPDX-License-Identifier: Apache-2.0
// What the monitor adds to a round trip over DDS: EngineSensors out, EngineHealth back, through a bare echo process and
// through the real monitor, in one run. The two take turns sample by sample, half a period apart, each on a domain of
// its own, so that whatever else the machine does hits both alike.
//
// Usage: echo_bench --design FILE [--seconds 60] [--period-ms 15] [--domain 44] [--monitor-flag FLAG]...
// Exit:  0 measured and within the limits asked for, 1 not, 2 wrong usage

#include <fmt/format.h>
#include <time.h>

#include <CLI/CLI.hpp>
#include <array>
#include <chrono>
#include <fastdds/dds/core/condition/WaitSet.hpp>
#include <thread>

#include "deploy/runtime/config/usage_answer.h"
#include "engine_sim/pacer.h"
#include "idl/dds/endpoint.h"
#include "tests/bench/child_process.h"
#include "tests/bench/percentiles.h"
#include "tests/bench/trim_sample.h"

namespace ehm::tuner_design {
namespace {

constexpr double asked_p50_us = 10.0, asked_p99_us = 50.0;
constexpr std::size_t block = 200;  ///< samples whose p99 is taken by itself

std::int64_t now_ns() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return t.tv_sec * std::int64_t{1'000'000'000} + t.tv_nsec;
}

idl::ParticipantOptions on_domain(std::uint32_t domain) {
  idl::ParticipantOptions options;
  options.domain = domain;
  options.name = "echo bench";
  return options;
}

/// One side of the comparison: who answers on a domain, and how long that takes.
class RoundTrip {
 public:
  RoundTrip(std::uint32_t domain, const TrimSample& engine)
      : participant_(on_domain(domain)), sensors_(participant_), health_(participant_), engine_(engine) {
    wait_set_.attach_condition(health_.condition());
  }
  bool matched() const { return sensors_.matched() > 0 && health_.matched() > 0; }

  /// Sends the next sample and waits for its answer; records the time unless nothing came within a period.
  void measure(std::int64_t period_ns, bool warm_up) {
    const EngineSensors& sample = engine_.next(period_ns);
    const std::int64_t sent_ns = now_ns();
    sensors_.write(sample);
    while (now_ns() - sent_ns < period_ns / 2) {
      EngineHealth answer;
      while (health_.take(answer)) {
        if (answer.sequence_number() != sample.sequence_number()) continue;
        if (!warm_up) times_us.push_back(1e-3 * static_cast<double>(now_ns() - sent_ns));
        return;
      }
      wait_set_.wait(triggered_, eprosima::fastrtps::Duration_t(0.005L));
    }
    if (!warm_up) ++unanswered;
  }

  std::vector<double> times_us;
  int unanswered = 0;

 private:
  idl::Participant participant_;
  idl::Writer<EngineSensors> sensors_;
  idl::Reader<EngineHealth> health_;
  eprosima::fastdds::dds::WaitSet wait_set_;
  eprosima::fastdds::dds::ConditionSeq triggered_;
  TrimSample engine_;
};

struct Row {
  const char* name;
  double bare_us, monitor_us, asked_us;  ///< asked_us 0: shown only
};

/// Prints the table; true if what the monitor adds is within what is asked.
bool report(RoundTrip& bare, RoundTrip& monitor) {
  fmt::print("round trips: bare echo {} ({} unanswered), monitor {} ({} unanswered)\n", bare.times_us.size(),
             bare.unanswered, monitor.times_us.size(), monitor.unanswered);
  const auto row = [&](const char* name, const auto& of, double asked_us) {
    return Row{name, of(bare.times_us), of(monitor.times_us), asked_us};
  };
  const auto blocks = [](double share) {
    return [share](const std::vector<double>& t) { return median_of_blocks(t, block, share); };
  };
  const auto pooled = [](double share) { return [share](std::vector<double>& t) { return percentile(t, share); }; };
  // The blocks first: pooled percentiles reorder the values.
  const std::array rows{row("p50, median of blocks", blocks(0.5), 0.0), row("p99, median of blocks", blocks(0.99), 0.0),
                        row("p50", pooled(0.5), asked_p50_us), row("p99", pooled(0.99), asked_p99_us),
                        row("p99.9", pooled(0.999), 0.0)};
  fmt::print("{:24s}{:>14s}{:>14s}{:>14s}{:>14s}\n", "round trip, us", "bare echo", "monitor", "added", "asked");
  bool within = !bare.times_us.empty() && !monitor.times_us.empty();
  for (const Row& r : rows) {
    const double added_us = r.monitor_us - r.bare_us;
    fmt::print("{:24s}{:14.1f}{:14.1f}{:14.1f}{:>14s}\n", r.name, r.bare_us, r.monitor_us, added_us,
               r.asked_us > 0.0 ? fmt::format("<= {:.0f}", r.asked_us) : "");
    within = within && (r.asked_us == 0.0 || added_us <= r.asked_us);
  }
  return within;
}

struct Options {
  std::string design;
  double seconds = 60.0, period_ms = 15.0;
  std::uint32_t domain = 44;
  std::vector<std::string> monitor_flags;
};

int run(const Options& options) {
  const TrimSample trim(options.design);
  std::vector<std::string> monitor_command{EHM_MONITOR,
                                           "--monitor-design",
                                           options.design,
                                           "--log-level",
                                           "warn",
                                           "--dds-domain",
                                           std::to_string(options.domain + 1)};
  monitor_command.insert(monitor_command.end(), options.monitor_flags.begin(), options.monitor_flags.end());
  const ChildProcess echo({EHM_BARE_ECHO, std::to_string(options.domain)});
  const ChildProcess monitor_process(monitor_command);
  RoundTrip bare(options.domain, trim), monitor(options.domain + 1, trim);
  for (int i = 0; !(bare.matched() && monitor.matched()); ++i) {
    if (i == 1000) throw std::runtime_error("the bare echo or the monitor did not match within 10 s");
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  const auto period_ns = static_cast<std::int64_t>(1e6 * options.period_ms);
  const auto warm_up = static_cast<int>(3e3 / options.period_ms);
  const auto samples = static_cast<int>(1e3 * options.seconds / options.period_ms);
  engine_sim::Pacer pacer(0.5e-3 * options.period_ms);
  for (int i = -warm_up; i < samples; ++i) {
    bare.measure(period_ns, i < 0);
    pacer.wait();
    monitor.measure(period_ns, i < 0);
    pacer.wait();
  }
  return report(bare, monitor) ? 0 : 1;
}

}  // namespace
}  // namespace ehm::tuner_design

int main(int argc, char** argv) {
  ehm::tuner_design::Options options;
  CLI::App app{"What the monitor adds to a round trip over DDS"};
  app.add_option("--design", options.design, "design file of the monitor")->required()->check(CLI::ExistingFile);
  app.add_option("--seconds", options.seconds, "how long to measure")->check(CLI::Range(0.1, 86400.0));
  app.add_option("--period-ms", options.period_ms, "of the samples")->check(CLI::Range(1.0, 1000.0));
  app.add_option("--domain", options.domain, "DDS domain of the bare echo; the next one is the monitor's")
      ->check(CLI::Range(0, 231));
  app.add_option("--monitor-flag", options.monitor_flags, "passed to the monitor, such as --realtime-policy=fifo");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return ehm::config::usage_answer(app, e);
  }
  try {
    return ehm::tuner_design::run(options);
  } catch (const std::exception& e) {
    fmt::print(stderr, "echo_bench: {}\n", e.what());
    return 1;
  }
}
