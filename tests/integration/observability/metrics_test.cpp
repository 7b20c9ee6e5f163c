// SPDX-License-Identifier: Apache-2.0
// What /metrics, /health and /ready say of a flying pair, against what MonitorStatus and HealthEvent said on DDS.

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <fstream>
#include <set>
#include <sstream>

#include "tests/integration/observability/stopped_thread.h"
#include "tests/integration/observability/watched_pair.h"

namespace {

using namespace ehm;
using namespace ehm::test;
using testing::HasSubstr;

using MetricsTest = WatchedPairTest;
const Labels engine_1{{"engine", "1"}, {"source", "101"}};

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// Names, types and units as Prometheus' guidelines ask.
void expect_good_names(const Exposition& metrics) {
  for (const auto& [name, family] : metrics.families()) {
    EXPECT_TRUE(name.starts_with("ehm_") || name.starts_with("process_")) << name;
    EXPECT_EQ(name.ends_with("_total"), family.type == "counter") << name;
    EXPECT_TRUE(family.help.ends_with('.')) << name;
    static const std::regex scaled_unit("_(us|ms|ns|percent|kilobytes|minutes|hours|milliseconds|microseconds)(_|$)");
    EXPECT_FALSE(std::regex_search(name, scaled_unit)) << name;
    const bool may_be_negative = name == "ehm_estimate" || name == "ehm_eta";
    for (const auto& [labels, value] : family.series) EXPECT_TRUE(value >= 0 || may_be_negative) << name;
  }
}

void expect_grown(const Exposition& before, const Exposition& after) {
  for (const auto& [name, family] : before.families()) {
    if (family.type != "counter") continue;
    for (const auto& [labels, value] : family.series)
      EXPECT_GE(after.families().at(name).series.at(labels), value) << name;
  }
}

void expect_equal(const Exposition& metrics, const MonitorStatus& s) {
  const std::map<std::string, double> counted{{"ehm_level", s.level()},
                                              {"ehm_samples_received_total", s.samples_received()},
                                              {"ehm_samples_processed_total", s.samples_processed()},
                                              {"ehm_samples_lost_total", s.samples_lost()},
                                              {"ehm_samples_malformed_total", s.samples_malformed()},
                                              {"ehm_samples_withheld_total", s.samples_withheld()},
                                              {"ehm_sensor_rejections_total", s.sensor_rejections()},
                                              {"ehm_deadline_misses_total", s.deadline_misses()},
                                              {"ehm_writes_refused_total", s.writes_refused()},
                                              {"ehm_input_rate_hertz", s.rate_hz()},
                                              {"ehm_flight_phase", s.flight_phase()},
                                              {"ehm_flight_number", s.flight()},
                                              {"ehm_n1_corrected_rpm", s.n1_corrected_rpm()},
                                              {"ehm_validity_distance", s.validity_distance()},
                                              {"ehm_latency_max_seconds", 1e-6 * s.latency_max_us()}};
  for (const auto& [name, value] : counted) EXPECT_DOUBLE_EQ(metrics.value(name, engine_1), value) << name;
  Labels p99 = engine_1;
  p99["percentile"] = "99";
  EXPECT_DOUBLE_EQ(metrics.value("ehm_latency_seconds", p99), 1e-6 * s.latency_p99_us());
}

/// As published, to single precision, of some sample up to one status period before the scrape.
void expect_estimates(const Exposition& metrics, const Listener& heard) {
  Labels labels = engine_1;
  labels["channel"] = "hpc_efficiency";
  labels["unit"] = "fraction";
  const double value = metrics.value("ehm_estimate", labels), sigma = metrics.value("ehm_estimate_sigma", labels);
  constexpr std::size_t hpc_efficiency = 4;
  EXPECT_TRUE(std::any_of(heard.health.begin(), heard.health.end(),
                          [&](const EngineHealth& h) {
                            return static_cast<float>(h.health()[hpc_efficiency]) == static_cast<float>(value) &&
                                   static_cast<float>(h.sigma_total()[hpc_efficiency]) == static_cast<float>(sigma);
                          }))
      << value << " +- " << sigma;
}

TEST_F(MetricsTest, SayWhatTheStatusSays) {
  const auto monitor = start_watched_monitor();
  EXPECT_EQ(get("/ready").status, 503);
  EXPECT_THAT(get("/ready").body, HasSubstr("no engine has been heard"));
  EXPECT_EQ(get("/health").status, 200);
  expect_good_names(scrape());  // before any engine: no family without series

  const auto simulator = start_simulator();
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > 30; }));
  SimCommand fault;
  fault.engine_id(1);
  fault.schema(idl::schema_version);
  fault.kind(static_cast<std::uint32_t>(idl::SimCommandKind::sensor_fault));
  fault.channel(4);
  fault.fault(static_cast<std::uint32_t>(idl::SensorFaultKind::dropout));
  idl::Writer<SimCommand> commands(participant_);
  ASSERT_TRUE(listener_.await([&] { return commands.matched() == 1; }));
  const Exposition before = scrape();
  ASSERT_TRUE(commands.write(fault));
  ASSERT_TRUE(listener_.await([&] { return listener_.has_event(idl::EventKind::sensor_fault, true); }));
  const Exposition after = scrape();
  expect_good_names(after);
  expect_grown(before, after);
  EXPECT_GT(after.value("ehm_cycle_turns_total"), before.value("ehm_cycle_turns_total"));
  EXPECT_GT(after.value("process_resident_memory_bytes"), 5e6);
  EXPECT_GT(after.value("ehm_input_rate_hertz", engine_1), 0.0);  // since the status before, which may be just past
  Labels sensor_fault = engine_1;
  sensor_fault["kind"] = "sensor_fault";
  EXPECT_EQ(before.value("ehm_events_total", sensor_fault), 0.0);
  EXPECT_EQ(after.value("ehm_events_total", sensor_fault), 1.0);
  const auto* event = listener_.find_event(idl::EventKind::sensor_fault, true);
  sensor_fault["channel"] = event->channel_name().c_str();
  EXPECT_EQ(after.value("ehm_condition_active", sensor_fault), 1.0);
  EXPECT_EQ(get("/ready").status, 200);
  expect_estimates(after, listener_);

  simulator->signal(SIGTERM);
  ASSERT_TRUE(listener_.await([&] {
    return !listener_.status.empty() &&
           listener_.status.back().level() == static_cast<std::uint32_t>(idl::StatusLevel::stale);
  }));
  // Without input nothing is counted any more: the last status is the truth for every later scrape.
  expect_equal(scrape(), listener_.status.back());
  const auto ready = get("/ready");
  EXPECT_EQ(ready.status, 503);
  EXPECT_FALSE(scrape().has("ehm_estimate"));  // without input there is none
  EXPECT_EQ(nlohmann::json::parse(ready.body)["engines"]["STALE"], nlohmann::json::array({1}));
  EXPECT_EQ(get("/health").status, 200);  // an engine that is off is no reason to restart the monitor
  EXPECT_EQ(get("/else").status, 404);
}

TEST_F(MetricsTest, OfALoopThatHangsTellTheirAgeAndAreNotReady) {
  const auto monitor = start_watched_monitor();
  const auto simulator = start_simulator();
  ASSERT_TRUE(listener_.await([&] { return get("/ready").status == 200; }));
  const Labels cycle{{"loop", "cycle"}, {"source", "101"}};
  EXPECT_LT(scrape().value("ehm_loop_age_seconds", cycle), 0.25);
  try {
    const StoppedThread hung(monitor->pid());
    ASSERT_TRUE(listener_.await([&] { return get("/ready").status == 503; }));
    EXPECT_THAT(get("/ready").body, HasSubstr("the cycle thread has stalled for"));
    ASSERT_TRUE(listener_.await([&] { return scrape().value("ehm_input_age_seconds", engine_1) > 0.5; }));
    EXPECT_GT(scrape().value("ehm_loop_age_seconds", cycle), 0.25);
    ASSERT_TRUE(listener_.await([&] { return scrape().value("ehm_status_age_seconds", engine_1) > 1.4; }));
    EXPECT_THAT(get("/ready").body, HasSubstr("the status of engines [1] is up to"));
  } catch (const std::runtime_error& e) {
    GTEST_SKIP() << "this system lets no test stop a thread: " << e.what();
  }
  EXPECT_TRUE(listener_.await([&] { return get("/ready").status == 200; })) << get("/ready").body;
}

TEST_F(MetricsTest, AreWhatDashboardAlertsAndDocumentationName) {
  const auto monitor = start_watched_monitor({"--estimator-shadow", "time_varying"});
  const auto simulator = start_simulator();
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > 10 && !listener_.status.empty(); }));
  Exposition metrics = scrape();
  // Conditions have a series once one was raised, a certificate under DDS Security.
  const std::set<std::string> not_here{"ehm_condition_active", "ehm_certificate_expiry_seconds",
                                       "ehm_egt_margin_kelvin", "ehm_egt_margin_sigma_kelvin"};
  const std::regex name("\\b(ehm|process)_[a-z_]*[a-z]\\b(?!\\.)");
  const std::string page = text_of(EHM_SOURCE_DIR "/deploy/docs/observability.md");
  for (const char* file : {"/deploy/dashboards/grafana_ehm.json", "/deploy/dashboards/alert_rules.yml"}) {
    const std::string text = text_of(EHM_SOURCE_DIR + std::string(file));
    int found = 0;
    for (std::sregex_iterator it(text.begin(), text.end(), name), end; it != end; ++it, ++found)
      EXPECT_TRUE(metrics.has(it->str()) || not_here.contains(it->str())) << file << ": " << it->str();
    EXPECT_GT(found, 10) << file;
  }
  for (const auto& [metric, family] : metrics.families()) EXPECT_THAT(page, HasSubstr("`" + metric + "`"));
}

TEST_F(MetricsTest, TellHowEachEstimatorDoes) {
  const auto monitor = start_watched_monitor({"--estimator-shadow", "time_varying"});
  const auto simulator = start_simulator();
  Labels shadow = engine_1, tuner = engine_1;
  shadow["estimator"] = "time_varying";
  tuner["estimator"] = "tuner";
  Exposition metrics = scrape();
  ASSERT_TRUE(listener_.await([&] {
    metrics = scrape();
    return metrics.has("ehm_estimator_samples_total") && metrics.value("ehm_estimator_samples_total", shadow) > 100.0;
  }));
  EXPECT_EQ(metrics.value("ehm_estimator_published", tuner), 1.0);
  EXPECT_EQ(metrics.value("ehm_estimator_published", shadow), 0.0);
  EXPECT_EQ(metrics.value("ehm_estimator_difference", tuner), 0.0);
  EXPECT_GT(metrics.value("ehm_estimator_difference", shadow), 0.0);
  for (const Labels& labels : {tuner, shadow}) {
    const double samples = metrics.value("ehm_estimator_samples_total", labels);
    EXPECT_EQ(metrics.value("ehm_estimator_answers_total", labels), samples);
    EXPECT_GT(metrics.value("ehm_estimator_seconds_total", labels), 1e-7 * samples);  // no filter is that fast
    EXPECT_GE(metrics.value("ehm_estimator_longest_seconds", labels),
              metrics.value("ehm_estimator_seconds_total", labels) / samples);
    const double ratio = metrics.value("ehm_estimator_innovation_ratio", labels);  // less than 1 while it converges
    EXPECT_GT(ratio, 0.3);
    EXPECT_LT(ratio, 1.3);
  }
}

TEST_F(MetricsTest, ATakenPortIsSaidAndTheMonitorFlies) {
  const auto first = start_watched_monitor();
  const auto second =
      start_monitor({"--monitor-source-id", "102", "--metrics-listen", "127.0.0.1:" + std::to_string(port_)});
  ASSERT_TRUE(listener_.await([&] { return second->log().find("no metrics") != std::string::npos; })) << second->log();
  EXPECT_THAT(second->log(), testing::AllOf(HasSubstr("127.0.0.1:" + std::to_string(port_)),
                                            HasSubstr("Address already in use"), HasSubstr("--metrics-listen")));
  const auto simulator = start_simulator({"--run-wait-for-monitors", "3"});
  const auto estimates_of = [&](std::uint32_t source) {
    return std::count_if(listener_.health.begin(), listener_.health.end(),
                         [&](const EngineHealth& h) { return h.source_id() == source; });
  };
  EXPECT_TRUE(listener_.await([&] { return estimates_of(101) > 5 && estimates_of(102) > 5; }));
  EXPECT_EQ(scrape().value("ehm_engines", {{"source", "101"}}), 1.0);  // the first still answers, and for itself
}

TEST_F(MetricsTest, AnAddressThatIsNoneIsAWrongConfiguration) {
  const auto monitor = start_monitor({"--metrics-listen", "127.0.0.1"});
  EXPECT_EQ(monitor->wait(seconds(20)), 2);
  EXPECT_THAT(monitor->log(), HasSubstr("'metrics.listen' is '127.0.0.1', allowed is HOST:PORT"));
}

}  // namespace
