// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/fleet_run.h"

#include <algorithm>
#include <chrono>
#include <fastdds/dds/core/condition/WaitSet.hpp>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "idl/dds/endpoint.h"
#include "tests/bench/child_process.h"

namespace ehm::tuner_design {
namespace {

using Clock = std::chrono::steady_clock;

/// Processor time of a process so far, s.
double cpu_seconds(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string text((std::istreambuf_iterator<char>(file)), {});
  std::istringstream fields(text.substr(std::min(text.size(), text.rfind(')') + 1)));
  std::string skipped;
  for (int i = 3; i < 14; ++i) fields >> skipped;  // proc(5): utime and stime are fields 14 and 15
  double user = 0.0, system = 0.0;
  fields >> user >> system;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

double resident_mb(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/statm");
  double total = 0.0, resident = 0.0;
  file >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

/// A subscriber of what the monitor says, and its count of it.
class Subscriber {
 public:
  explicit Subscriber(idl::Participant& participant) : health_(participant), status_(participant) {
    wait_set_.attach_condition(health_.condition());
    wait_set_.attach_condition(status_.condition());
  }
  bool matched() const { return health_.matched() > 0 && status_.matched() > 0; }
  void listen(std::chrono::milliseconds limit) {
    const auto end = Clock::now() + limit;
    while (Clock::now() < end) {
      wait_set_.wait(triggered_, eprosima::fastrtps::Duration_t(0.01L));
      EngineHealth estimate;
      while (health_.take(estimate)) ++estimates;
      MonitorStatus s;
      while (status_.take(s)) status[s.engine_id()] = s;
    }
  }

  std::uint64_t estimates = 0;
  std::map<std::uint32_t, MonitorStatus> status;  ///< latest of each engine

 private:
  idl::Reader<EngineHealth> health_;
  idl::Reader<MonitorStatus> status_;
  eprosima::fastdds::dds::WaitSet wait_set_;
  eprosima::fastdds::dds::ConditionSeq triggered_;
};

FleetResult summary(const FleetOptions& options, const Subscriber& subscriber) {
  FleetResult r;
  r.engines = options.engines;
  r.sent = options.engines * static_cast<std::uint64_t>(1e3 * options.seconds / options.period_ms);
  r.estimates = subscriber.estimates;
  std::vector<double> p50;
  for (const auto& [id, s] : subscriber.status) {
    r.lost += s.samples_lost() + s.writes_refused();
    r.late += s.deadline_misses();
    r.p99_us = std::max(r.p99_us, s.latency_p99_us());
    r.max_us = std::max(r.max_us, s.latency_max_us());
    p50.push_back(s.latency_p50_us());
  }
  if (p50.empty()) return r;
  std::nth_element(p50.begin(), p50.begin() + static_cast<std::ptrdiff_t>(p50.size() / 2), p50.end());
  r.p50_us = p50[p50.size() / 2];
  return r;
}

}  // namespace

FleetResult fly_fleet(const FleetOptions& options) {
  const auto text = [](auto value) { return std::to_string(value); };
  const ChildProcess monitor({EHM_MONITOR, "--monitor-design", options.design, "--estimator-published",
                              options.estimator, "--dds-domain", text(options.domain), "--monitor-max-engines",
                              text(options.engines), "--log-level", "error", "--metrics-listen", ""});
  idl::ParticipantOptions participant_options;
  participant_options.domain = options.domain;
  participant_options.name = "fleet bench";
  idl::Participant participant(participant_options);
  Subscriber subscriber(participant);
  for (int i = 0; !subscriber.matched(); ++i) {
    if (i == 100) throw std::runtime_error("the monitor did not match within 10 s");
    subscriber.listen(std::chrono::milliseconds(100));
  }
  const double cpu_before_s = cpu_seconds(monitor.pid());
  const auto start = Clock::now();
  const ChildProcess replay({EHM_FLEET_REPLAY, "--design", options.design, "--domain", text(options.domain),
                             "--engines", text(options.engines), "--seconds", text(options.seconds), "--period-ms",
                             text(options.period_ms)});
  subscriber.listen(std::chrono::milliseconds(static_cast<int>(1e3 * options.seconds)));
  const double cpu_s = cpu_seconds(monitor.pid()) - cpu_before_s;
  const double elapsed_s = std::chrono::duration<double>(Clock::now() - start).count();
  const double memory_mb = resident_mb(monitor.pid());
  subscriber.listen(std::chrono::milliseconds(2500));  // the rest of the samples, and one status more
  FleetResult r = summary(options, subscriber);
  r.cpu_percent = 100.0 * cpu_s / elapsed_s;
  r.memory_mb = memory_mb;
  return r;
}

}  // namespace ehm::tuner_design
