// SPDX-License-Identifier: Apache-2.0
// Who reads the log may stop or go away; the flight, its events and its end do not wait for him.

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>

#include "tests/integration/pair/pair.h"
#include "tests/temporary_folder.h"

namespace {

using namespace ehm;
using namespace ehm::test;

class LogReaderTest : public PairTest {
 protected:
  LogReaderTest() {
    mkfifo(pipe_.c_str(), 0600);
    reader_ = open(pipe_.c_str(), O_RDWR | O_NONBLOCK);
  }
  ~LogReaderTest() override { gone(); }
  void gone() {
    if (reader_ >= 0) close(reader_);
    reader_ = -1;
  }
  /// Not one byte more fits.
  void fill() const {
    const std::string block(4096, 'x');
    while (write(reader_, block.data(), block.size()) > 0) {
    }
    while (write(reader_, "x", 1) > 0) {
    }
  }
  /// Its standard error is the pipe.
  std::unique_ptr<Process> start(const std::string& command) {
    return std::make_unique<Process>(
        std::vector<std::string>{"/bin/bash", "-c", "exec " + command + " 2>'" + pipe_ + "'"});
  }
  std::string monitor_command() const {
    return "'" + monitor_program() + "' --monitor-design '" + design_file() + "' --dds-domain " +
           std::to_string(domain_) + " --monitor-status-period-s 0.1 --metrics-listen ''";
  }
  std::string simulator_command() const {
    return "'" + simulator_program() + "' --config " EHM_SOURCE_DIR "/deploy/demo/engine_sim.toml --dds-domain " +
           std::to_string(domain_) + " --run-wait-for-monitors 2";
  }
  void expect_flight(Process& monitor, Process& simulator) {
    const std::size_t before = listener_.health.size();
    ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > before + 100 && !listener_.status.empty(); }));
    EXPECT_TRUE(monitor.running());
    EXPECT_TRUE(simulator.running());
  }
  TemporaryFolder folder_;
  std::string pipe_ = folder_.path("log");
  int reader_ = -1;
};

TEST_F(LogReaderTest, WhoStopsReadingHoldsUpNeitherFlightNorEventsNorTheStop) {
  fill();
  const auto monitor = start(monitor_command());
  const auto simulator = start(simulator_command());
  expect_flight(*monitor, *simulator);
  simulator->signal(SIGTERM);
  EXPECT_EQ(simulator->wait(seconds(4)), 0);
  EXPECT_TRUE(listener_.await([&] { return listener_.has_event(idl::EventKind::input_lost, true); }));
  monitor->signal(SIGTERM);
  EXPECT_TRUE(listener_.await(
      [&] { return listener_.status.back().level() == static_cast<std::uint32_t>(idl::StatusLevel::stopped); }));
  EXPECT_EQ(monitor->wait(seconds(4)), 0);
}

TEST_F(LogReaderTest, WhoGoesAwayEndsNobody) {
  const auto monitor = start(monitor_command());
  const auto simulator = start(simulator_command());
  expect_flight(*monitor, *simulator);
  gone();
  MonitorCommand reset;  // something to say
  reset.schema(idl::schema_version);
  reset.kind(static_cast<std::uint32_t>(idl::MonitorCommandKind::reset));
  idl::Writer<MonitorCommand> commands(participant_);
  ASSERT_TRUE(listener_.await([&] { return commands.matched() > 0; }));
  commands.write(reset);
  EXPECT_TRUE(listener_.await([&] { return listener_.has_event(idl::EventKind::filter_restart, true); }));
  expect_flight(*monitor, *simulator);
  monitor->signal(SIGTERM);
  EXPECT_EQ(monitor->wait(seconds(4)), 0);
}

}  // namespace
