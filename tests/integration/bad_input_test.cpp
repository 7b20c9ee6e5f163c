// SPDX-License-Identifier: Apache-2.0
// A hostile peer on the wire, and bad files: each mistake has its counter or its message, and the service goes on.

#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <limits>

#include "tests/integration/pair/engine_samples.h"
#include "tests/integration/pair/pair.h"

namespace {

using namespace ehm;
using namespace ehm::test;

class BadSamplesTest : public PairTest {
 protected:
  void SetUp() override {
    monitor_ = start_monitor({"--monitor-max-engines", "1", "--monitor-status-period-s", "0.1"});
    ASSERT_TRUE(listener_.await([&] { return writer_.matched() == 2; }));
  }
  EngineSensors good() { return samples_.next(); }
  /// Sends and waits until the monitor has counted it.
  MonitorStatus send(const EngineSensors& sample) {
    writer_.write(sample);
    ++sent_;
    EXPECT_TRUE(listener_.await(
        [&] { return !listener_.status.empty() && listener_.status.back().samples_received() >= sent_; }));
    return listener_.status.back();
  }
  std::unique_ptr<Process> monitor_;
  idl::Writer<EngineSensors> writer_{participant_};
  EngineSamples samples_{design_file(), 1};
  std::uint64_t sent_ = 0;
};

TEST_F(BadSamplesTest, EachHasItsCounter) {
  for (int i = 0; i < 5; ++i) send(good());
  EngineSensors s = good();
  s.sensor()[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(send(s).sensor_rejections(), 1u);
  s = good();
  s.sensor()[3] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(send(s).sensor_rejections(), 2u);
  s = good();
  s.sensor()[4] = 10.0 * samples_.trim()[4];
  EXPECT_EQ(send(s).sensor_rejections(), 3u);
  ASSERT_TRUE(listener_.await([&] { return listener_.residuals.size() == 8; }));
  EXPECT_EQ(listener_.residuals[5].reason()[2], idl::reject_reason::not_finite);
  EXPECT_EQ(listener_.residuals[6].reason()[3], idl::reject_reason::not_finite);
  EXPECT_TRUE(listener_.residuals[7].reason()[4] & idl::reject_reason::range);

  s = good();
  send(s);
  EXPECT_EQ(send(s).samples_duplicated(), 1u);
  // A dropped sample is no error of the estimation.
  EXPECT_NE(listener_.status.back().level(), static_cast<std::uint32_t>(idl::StatusLevel::error));
  const EngineSensors late = good(), early = good();
  send(early);
  EXPECT_EQ(send(late).samples_reordered(), 1u);
  EXPECT_EQ(listener_.status.back().samples_lost(), 1u);  // the late one's place in the sequence was taken as lost

  s = good();
  s.sensor_count(99);
  EXPECT_EQ(send(s).samples_malformed(), 1u);
  s = good();
  s.schema(77);
  EXPECT_EQ(send(s).samples_malformed(), 2u);
  // The way back from ten times the trim was too far for one sample, too.
  const std::uint64_t rejected = listener_.status.back().sensor_rejections();
  EXPECT_EQ(rejected, 4u);
  s = good();
  s.actuator()[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(send(s).sensor_rejections(), rejected + 1u);  // bridged by the last good word
  EXPECT_EQ(listener_.status.back().samples_malformed(), 2u);

  s = good();
  s.engine_id(2);
  writer_.write(s);
  ASSERT_TRUE(listener_.await([&] { return listener_.status.back().unknown_engine_samples() == 1; }));

  const std::size_t estimates = listener_.health.size();
  send(good());
  EXPECT_TRUE(listener_.await([&] { return listener_.health.size() == estimates + 1; }));
  EXPECT_TRUE(monitor_->running());
}

TEST_F(BadSamplesTest, TimeJumpingBackwardsRestartsTheFilterAndSaysSo) {
  for (int i = 0; i < 5; ++i) send(good());
  EngineSensors s = good();
  s.source_time_ns(s.source_time_ns() - 100'000'000'000);
  EXPECT_EQ(send(s).filter_restarts(), 1u);
  EXPECT_TRUE(listener_.await([&] { return listener_.has_event(idl::EventKind::filter_restart, true); }));
}

class BadFilesTest : public PairTest {
 protected:
  /// Runs a program to its end; returns its exit code and, through `log`, what it said.
  std::optional<int> run(const std::vector<std::string>& arguments, std::string& log) {
    Process process(arguments);
    const auto code = process.wait(seconds(20));
    log = process.log();
    return code;
  }
  void expect_refused(const std::vector<std::string>& arguments, const std::string& message) {
    std::string log;
    EXPECT_EQ(run(arguments, log), 2) << log;
    EXPECT_NE(log.find(message), std::string::npos) << log;
  }
};

TEST_F(BadFilesTest, TheMonitorNamesWhatIsWrong) {
  const std::string good = design_file();
  expect_refused({monitor_program(), "--monitor-design", "nowhere.json"}, "nowhere.json");
  std::string text = nlohmann::json::parse(std::ifstream(good)).dump(1);
  expect_refused({monitor_program(), "--monitor-design", file("truncated.json", text.substr(0, text.size() / 2))},
                 "truncated.json");
  auto edited = nlohmann::json::parse(text);
  edited["model"]["health"][0]["sigma"] = 0.5;
  expect_refused({monitor_program(), "--monitor-design", file("edited.json", edited.dump())}, "hash");
  edited["schema"] = "ehm-design/0";
  expect_refused({monitor_program(), "--monitor-design", file("older.json", edited.dump())}, "ehm-design/0");
  expect_refused({monitor_program(), "--config", file("m.toml", "[checks]\ngate_sigma = 100\n")},
                 "m.toml:2: 'checks.gate_sigma' is 100, allowed is a number from 2 to 20 sigma");
  expect_refused({monitor_program(), "--monitor-design", good, "--config",
                  file("limit.toml", "[[limit]]\nquantity = \"T41\"\nmax = 1.0\n")},
                 "limit.quantity is 'T41', which the design does not estimate");
  expect_refused({monitor_program()}, "no design: set monitor.design");
  expect_refused({monitor_program(), "--unknown"}, "monitor: unknown option --unknown. See monitor --help");
}

TEST_F(BadFilesTest, TheSimulatorNamesWhatIsWrong) {
  expect_refused({simulator_program(), "--config", "nowhere.toml"}, "nowhere.toml: no such file");
  expect_refused({simulator_program(), "--flight-mach", "2"},
                 "flag --flight-mach: 'flight.mach' is 2, allowed is a number from 0 to 0.95");
  expect_refused({simulator_program(), "--config", file("s.toml", "[run\n")}, "not valid TOML");
}

TEST_F(BadFilesTest, AMisspeltOptionIsNamedByEachProgramWithWhatWasMeant) {
  const std::string monitor = monitor_program(), simulator = simulator_program();
  expect_refused({monitor, "--monitor-desing", "d.json"},
                 "monitor: unknown option --monitor-desing; did you mean --monitor-design? See monitor --help\n");
  expect_refused({simulator, "--dommain", "3"},
                 "engine_sim: unknown option --dommain; did you mean --dds-domain? See engine_sim --help\n");
  expect_refused({simulator, "deck", "--casse", "c.csv"},
                 "engine_sim deck: unknown option --casse; did you mean --cases? See engine_sim deck --help\n");
  expect_refused({EHM_TUNER_DESIGN, "chekc", "d.json"}, "tuner_design: unknown command 'chekc'; did you mean check?");
  expect_refused({EHM_WATCH, "--dommain=3"},
                 "ehm_watch: unknown option --dommain; did you mean --domain? See ehm_watch --help\n");
  expect_refused({EHM_WATCH, "--domain", "999"}, "ehm_watch: --domain: ");
  expect_refused({EHM_HOSTILE, "--kind", "bits"}, "ehm_hostile: unknown option --kind; did you mean --kinds?");
}

TEST_F(BadFilesTest, AMissingProfilesFileStopsWithItsName) {
  std::string log;
  EXPECT_EQ(run({monitor_program(), "--monitor-design", design_file(), "--dds-profiles-file", "nowhere.xml"}, log), 2);
  EXPECT_NE(log.find("dds profiles file nowhere.xml: no such file"), std::string::npos) << log;
  const std::string other = file("other.xml", "<profiles/>");
  EXPECT_EQ(
      run({monitor_program(), "--monitor-design", design_file(), "--dds-profiles-file", other, "--check-config"}, log),
      2);
  EXPECT_NE(log.find("dds profiles file '" + other + "'"), std::string::npos) << log;
}

TEST_F(BadFilesTest, WhatCannotBePrintedIsNoSuccess) {
  for (const std::string program : {EHM_TUNER_DESIGN, EHM_ENGINE_SIM, EHM_WATCH}) {
    std::string log;
    EXPECT_EQ(run({"/bin/bash", "-c", "'" + program + "' --help > /dev/full"}, log), 1) << program;
    EXPECT_NE(log.find("standard output cannot be written"), std::string::npos) << log;
  }
}

TEST_F(BadFilesTest, CheckConfigAcceptsTheShippedFiles) {
  std::string log;
  EXPECT_EQ(run({monitor_program(), "--check-config", "--config", EHM_SOURCE_DIR "/deploy/demo/monitor.toml",
                 "--monitor-design", design_file()},
                log),
            0)
      << log;
  EXPECT_EQ(
      run({simulator_program(), "--check-config", "--config", EHM_SOURCE_DIR "/deploy/demo/engine_sim.toml"}, log), 0)
      << log;
}

}  // namespace
