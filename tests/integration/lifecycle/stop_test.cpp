// SPDX-License-Identifier: Apache-2.0
// SIGTERM: everything is said and kept, within a second, whatever the readers do.

#include <chrono>
#include <csignal>
#include <filesystem>

#include "tests/integration/pair/pair.h"
#include "tests/temporary_folder.h"

namespace {

using namespace ehm;
using namespace ehm::test;

class StopTest : public PairTest {
 protected:
  /// Exit code of an ordered stop; prints how long it took.
  std::optional<int> stop(Process& monitor, const char* what) {
    const auto begin = std::chrono::steady_clock::now();
    monitor.signal(SIGTERM);
    const auto code = monitor.wait(seconds(5));
    const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    std::printf("stop, %s: %.2f s (asked 1)\n", what, took_s);
    EXPECT_LT(took_s, 2.0) << what;  // a busy machine's margin on 1 s
    return code;
  }
  TemporaryFolder folder_;
};

TEST_F(StopTest, FiftyEnginesAreKept) {
  const auto monitor = start_monitor({"--checkpoint-directory", folder_.path(), "--checkpoint-period-s", "3600",
                                      "--monitor-max-engines", "50", "--metrics-listen", ""});
  const auto simulator = start_simulator({"--run-duration-s", "2"});
  idl::Writer<EngineSensors> writer(participant_);
  ASSERT_TRUE(listener_.await([&] { return !listener_.sensors.empty() && writer.matched() == 2; }));
  // 49 more engines: the same samples under other numbers.
  std::size_t copied = 0;
  const auto copy = [&] {
    for (; copied < listener_.sensors.size(); ++copied) {
      if (listener_.sensors[copied].engine_id() != 1) continue;
      EngineSensors s = listener_.sensors[copied];
      for (std::uint32_t engine = 2; engine <= 50; ++engine) {
        s.engine_id(engine);
        writer.write(s);
      }
    }
    return !listener_.status.empty() && listener_.status.back().engine_id() == 50 &&
           listener_.status.back().samples_processed() > 10;
  };
  ASSERT_TRUE(listener_.await(copy));
  EXPECT_EQ(stop(*monitor, "50 engines with checkpoints"), 0);
  EXPECT_EQ(monitor->log().find("deadline"), std::string::npos) << "the middleware's false alarm is kept back";
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
    files += entry.path().extension() == ".json";
  EXPECT_EQ(files, 50u);
  EXPECT_TRUE(listener_.await([&] {
    return std::count_if(listener_.status.begin(), listener_.status.end(), [](const MonitorStatus& s) {
             return s.level() == static_cast<std::uint32_t>(idl::StatusLevel::stopped);
           }) == 50;
  }));
}

TEST_F(StopTest, ReadersSeeTheEstimatesEnd) {
  namespace dds = eprosima::fastdds::dds;
  using HealthTopic = idl::Topic<EngineHealth>;
  const auto monitor = start_monitor({"--metrics-listen", ""});
  const auto simulator = start_simulator();
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > 20; }));
  // A plain reader: ours passes over what is not data.
  auto* topic = participant_.topic(HealthTopic::name, dds::TypeSupport(new EngineHealthPubSubType()));
  auto* reader = participant_.subscriber()->create_datareader(
      topic, idl::reader_qos(HealthTopic::delivery, HealthTopic::estimate, {}));
  ASSERT_NE(reader, nullptr);
  EngineHealth estimate;
  dds::SampleInfo info;
  std::size_t estimates = 0;
  bool ended = false;
  const auto look = [&] {
    while (!ended &&
           reader->take_next_sample(&estimate, &info) == eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
      estimates += info.valid_data;
      ended = info.instance_state == dds::NOT_ALIVE_NO_WRITERS_INSTANCE_STATE;
    }
  };
  ASSERT_TRUE(listener_.await([&] {
    look();
    return estimates > 20;
  }));
  EXPECT_FALSE(ended);
  EXPECT_EQ(stop(*monitor, "readers see the end"), 0);
  EXPECT_TRUE(listener_.await([&] {
    look();
    return ended;
  }));
  EXPECT_EQ(listener_.status.back().level(), static_cast<std::uint32_t>(idl::StatusLevel::stopped));
  participant_.subscriber()->delete_datareader(reader);
}

TEST_F(StopTest, AReaderThatDoesNotAnswerDoesNotDelayIt) {
  const auto monitor = start_monitor({"--metrics-listen", ""});
  const auto simulator = start_simulator();
  const auto stuck = std::make_unique<Process>(
      std::vector<std::string>{EHM_WATCH, "--domain", std::to_string(domain_), "--seconds", "60"});
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > 200; }));
  stuck->signal(SIGSTOP);
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > 250; }));
  EXPECT_EQ(stop(*monitor, "a reader that is held up"), 0);
}

}  // namespace
