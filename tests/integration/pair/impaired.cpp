// SPDX-License-Identifier: Apache-2.0
#include "tests/integration/pair/impaired.h"

#include <unistd.h>

#include <csignal>
#include <sstream>

namespace ehm::test {

namespace {

std::uint32_t second_domain() {
  return 60 + static_cast<std::uint32_t>(getpid()) % 40;
}

std::string last_line(const std::string& text) {
  std::istringstream lines(text);
  std::string line, last;
  while (std::getline(lines, line)) last = line;
  return last;
}

}  // namespace

ImpairedTest::ImpairedTest()
    : source_domain_(second_domain()),
      source_participant_(options(source_domain_)),
      source_listener_(source_participant_) {}

void ImpairedTest::fly(double duration_s, const std::vector<std::string>& impair_flags, const std::string& schedule) {
  monitor_ = start_monitor({"--monitor-status-period-s", "0.1"});
  std::vector<std::string> arguments{
      EHM_IMPAIR, "--from", std::to_string(source_domain_), "--to", std::to_string(domain_), "--wait-for-readers", "2"};
  arguments.insert(arguments.end(), impair_flags.begin(), impair_flags.end());
  if (!schedule.empty()) {
    arguments.push_back("--schedule");
    arguments.push_back(file("schedule.txt", schedule));
  }
  Process impair(arguments);
  Process simulator({simulator_program(), "--config", EHM_SOURCE_DIR "/deploy/demo/engine_sim.toml", "--dds-domain",
                     std::to_string(source_domain_), "--run-wait-for-monitors", "2", "--run-duration-s",
                     std::to_string(duration_s)});
  // Both listeners are emptied while we wait: their histories hold less than a flight.
  const auto limit = seconds(30 + static_cast<int>(duration_s));
  ASSERT_TRUE(listener_.await(
      [&] {
        source_listener_.await([] { return true; });
        return !simulator.running();
      },
      limit));
  EXPECT_EQ(simulator.wait(seconds(1)), 0);
  ASSERT_TRUE(source_listener_.await([&] {
    listener_.await([] { return true; });
    return !listener_.status.empty() && !listener_.sensors.empty() &&
           status().level() == static_cast<std::uint32_t>(idl::StatusLevel::stale) && status().age_s() > 0.3 &&
           status().samples_received() >= listener_.sensors.size();
  }));
  impair.signal(SIGTERM);
  ASSERT_EQ(impair.wait(seconds(10)), 0) << impair.log();
  impairment_ = nlohmann::json::parse(last_line(impair.log()));
}

ImpairedTest::Account ImpairedTest::account() const {
  Account a;
  std::optional<std::uint64_t> last;
  for (const auto& s : listener_.sensors) {
    const std::uint64_t number = s.sequence_number();
    if (last && number == *last) {
      ++a.duplicated;
    } else if (last && number < *last) {
      ++a.reordered;
    } else {
      a.lost += last ? number - *last - 1 : 0;
      ++a.in_order;
      last = number;
    }
  }
  return a;
}

void ImpairedTest::expect_all_accounted_for() const {
  const Account a = account();
  const MonitorStatus& s = status();
  EXPECT_EQ(impaired("received"), source_listener_.truth.size());
  EXPECT_EQ(impaired("pending"), 0u);
  EXPECT_EQ(impaired("received") + impaired("duplicated"), impaired("sent") + impaired("dropped"));
  EXPECT_EQ(s.samples_received(), impaired("sent"));
  EXPECT_EQ(s.samples_received(), listener_.sensors.size());
  EXPECT_EQ(s.samples_processed() + s.samples_withheld(), a.in_order);
  EXPECT_EQ(s.samples_lost(), a.lost);
  EXPECT_EQ(s.samples_duplicated(), a.duplicated);
  EXPECT_EQ(s.samples_reordered(), a.reordered);
  EXPECT_EQ(s.samples_received(), s.samples_processed() + s.samples_withheld() + s.samples_duplicated() +
                                      s.samples_reordered() + s.samples_malformed() + s.samples_foreign());
  EXPECT_EQ(listener_.health.size(), s.samples_processed());
}

}  // namespace ehm::test
