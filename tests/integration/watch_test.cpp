// SPDX-License-Identifier: Apache-2.0
// ehm_watch as it is used: beside a simulator that tells the truth, beside a source that does not, and beside somebody
// who publishes a truth of his own.

#include <gmock/gmock.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "tests/integration/pair/pair.h"
#include "tests/temporary_folder.h"

namespace {

using namespace ehm;
using namespace ehm::test;
using Json = nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr const char* forged_notice = "EngineTruth of engine 1 from another participant is ignored";

class WatchTest : public PairTest {
 protected:
  std::unique_ptr<Process> start_watch(const std::string& seconds_of_flight) {
    return std::make_unique<Process>(std::vector<std::string>{
        EHM_WATCH, "--domain", std::to_string(domain_), "--seconds", seconds_of_flight, "--timeout", "30", "--json"});
  }
  /// Until `watch` ends, forges a truth for each sample that is heard: its number, its stamp, other values.
  void forge_until_it_ends(Process& watch) {
    std::size_t forged = 0;
    ASSERT_TRUE(listener_.await(
        [&] {
          for (; forged < listener_.sensors.size(); ++forged) {
            EngineTruth t;
            t.engine_id(1);
            t.schema(idl::schema_version);
            t.source_id(listener_.sensors[forged].source_id());
            t.sequence_number(listener_.sensors[forged].sequence_number());
            t.source_time_ns(listener_.sensors[forged].source_time_ns());
            t.health_count(10);
            t.auxiliary_count(4);
            t.health().fill(0.1);
            forger_.write(t);
          }
          return !watch.running();
        },
        seconds(60)));
    EXPECT_GT(forged, 100u);
  }
  /// What it printed on standard output, which is one object.
  static Json summary(const Process& watch) {
    const std::string log = watch.log();
    const auto begin = log.find("{\n"), end = log.rfind("\n}");
    return begin == std::string::npos || end == std::string::npos ? Json()
                                                                  : Json::parse(log.substr(begin, end + 2 - begin));
  }
  static int count(const std::string& text, const std::string& what) {
    int times = 0;
    for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++times;
    return times;
  }
  idl::Writer<EngineTruth> forger_{participant_};
  TemporaryFolder folder_;
};

TEST_F(WatchTest, AForgerOfTruthDoesNotChangeTheVerdict) {
  const auto watch = start_watch("9.9");  // before the demo's step; its noise is that of its seed
  ASSERT_TRUE(listener_.await([&] { return forger_.matched() == 2; }));  // the watch and the listener
  const auto monitor = start_monitor({"--monitor-status-period-s", "0.1"});
  const auto simulator = start_simulator({"--run-duration-s", "9.9"});
  forge_until_it_ends(*watch);
  EXPECT_EQ(watch->wait(seconds(1)), 0) << watch->log();
  EXPECT_EQ(count(watch->log(), forged_notice), 1) << watch->log();
  const Json json = summary(*watch);
  EXPECT_EQ(json["accuracy_judged"], true);
  EXPECT_GT(json["truth_ignored"], 100);
  EXPECT_EQ(json["samples_published"], 660);
  EXPECT_EQ(json["samples_lost"], 0);
  for (const Json& row : json["health"]) EXPECT_LT(row["truth"], 0.05) << row;
  EXPECT_GT(json["latency_us"]["p50"], 0.0);
}

TEST_F(WatchTest, WithoutTruthTheRunIsJudgedByLevelAndLosses) {
  const std::string recording = folder_.path("flight.h5");
  auto monitor = start_monitor({"--record", recording, "--monitor-status-period-s", "0.1"});
  const auto simulator = start_simulator({"--run-duration-s", "6", "--rate", "max"});
  ASSERT_TRUE(
      listener_.await([&] { return !listener_.status.empty() && listener_.status.back().samples_processed() == 400; }));
  monitor->signal(SIGTERM);
  ASSERT_EQ(monitor->wait(seconds(10)), 0);

  const auto watch = start_watch("5");
  ASSERT_TRUE(listener_.await([&] { return forger_.matched() == 2; }));
  monitor = start_monitor({"--monitor-status-period-s", "0.1"});
  const Process replay({simulator_program(), "--replay", recording, "--dds-domain", std::to_string(domain_),
                        "--run-wait-for-monitors", "2"});
  forge_until_it_ends(*watch);
  EXPECT_EQ(watch->wait(seconds(1)), 0) << watch->log();
  const Json json = summary(*watch);
  EXPECT_EQ(json["accuracy_judged"], false);
  EXPECT_EQ(json["samples_lost"], 0);
  EXPECT_EQ(json["samples_withheld"], 0);
  EXPECT_EQ(json["health"].size(), 10u);
  EXPECT_FALSE(json["health"][0].contains("truth"));
  EXPECT_EQ(json["sensors_used"].size(), 7u);
  EXPECT_THAT(watch->log(), HasSubstr("EngineTruth of engine 1 is ignored: no participant describes the engine"));
}

TEST_F(WatchTest, WithheldSamplesFailTheRun) {
  const auto monitor = start_monitor({"--monitor-status-period-s", "0.1"});
  const auto watch = std::make_unique<Process>(
      std::vector<std::string>{EHM_WATCH, "--domain", std::to_string(domain_), "--seconds", "5", "--timeout", "0"});
  ASSERT_TRUE(listener_.await([&] { return forger_.matched() == 2; }));
  // Far from the design's point.
  const auto simulator = start_simulator({"--flight-altitude-m", "0", "--flight-mach", "0"});
  ASSERT_TRUE(listener_.await([&] { return !watch->running(); }));
  EXPECT_EQ(watch->wait(seconds(1)), 1);
  EXPECT_THAT(watch->log(), HasSubstr("the flight did not come to its end; no estimate was heard"));
  EXPECT_THAT(watch->log(), HasSubstr("the monitor said ERROR"));
  EXPECT_THAT(watch->log(), HasSubstr("samples were withheld"));
  EXPECT_THAT(watch->log(), Not(HasSubstr(forged_notice)));
}

}  // namespace
