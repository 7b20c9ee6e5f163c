// SPDX-License-Identifier: Apache-2.0
// realtime.* on a real monitor: what the system grants is set, what it refuses is said, and it runs on either way.

#include <gmock/gmock.h>
#include <sched.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/integration/pair/pair.h"

namespace {

using namespace ehm;
using namespace ehm::test;
using testing::HasSubstr;
using testing::Not;

bool scheduler_permits_fifo() {
  sched_param parameter{};
  parameter.sched_priority = 10;
  const bool permitted = sched_setscheduler(0, SCHED_FIFO, &parameter) == 0;
  parameter.sched_priority = 0;
  sched_setscheduler(0, SCHED_OTHER, &parameter);
  return permitted;
}

/// Scheduling policies of all threads of a process, the main thread's first; SCHED_RESET_ON_FORK left away.
std::vector<int> thread_policies(pid_t process) {
  std::vector<int> policies{sched_getscheduler(process) & ~SCHED_RESET_ON_FORK};
  for (const auto& entry : std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task")) {
    const pid_t thread = std::stoi(entry.path().filename());
    if (thread != process) policies.push_back(sched_getscheduler(thread) & ~SCHED_RESET_ON_FORK);
  }
  return policies;
}

/// A line of /proc/PID/status, such as "VmLck".
std::string status_line(pid_t process, const std::string& name) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name + ":")) return line;
  return "";
}

class RealtimeTest : public PairTest {
 protected:
  /// The monitor listens, and all its threads are there: it has answered a sample.
  bool flies(const Process& monitor) {
    simulator_ = start_simulator();
    return listener_.await([&] { return listener_.health.size() > 20; }) && monitor.pid() > 0;
  }
  std::unique_ptr<Process> simulator_;
};

TEST_F(RealtimeTest, ByDefaultItIsANormalProcess) {
  const auto monitor = start_monitor();
  ASSERT_TRUE(flies(*monitor)) << monitor->log();
  EXPECT_THAT(thread_policies(monitor->pid()), testing::Each(SCHED_OTHER));
  EXPECT_THAT(monitor->log(), Not(HasSubstr("realtime")));
}

TEST_F(RealtimeTest, FifoIsOfTheCycleThreadAlone) {
  if (!scheduler_permits_fifo()) GTEST_SKIP() << "this container refuses SCHED_FIFO";
  const auto monitor =
      start_monitor({"--realtime-policy", "fifo", "--realtime-priority", "20", "--realtime-cpus", "0"});
  ASSERT_TRUE(flies(*monitor)) << monitor->log();
  const std::vector<int> policies = thread_policies(monitor->pid());
  EXPECT_EQ(policies.front(), SCHED_FIFO);
  EXPECT_EQ(std::count(policies.begin(), policies.end(), SCHED_FIFO), 1);
  sched_param parameter{};
  sched_getparam(monitor->pid(), &parameter);
  EXPECT_EQ(parameter.sched_priority, 20);
  EXPECT_EQ(status_line(monitor->pid(), "Cpus_allowed_list"), "Cpus_allowed_list:\t0");
  EXPECT_THAT(monitor->log(), Not(HasSubstr("refused")));
}

TEST_F(RealtimeTest, TheMiddlewareReceivesAtTheSamePriorityIfAsked) {
  if (!scheduler_permits_fifo()) GTEST_SKIP() << "this container refuses SCHED_FIFO";
  const auto monitor = start_monitor({"--realtime-policy", "fifo", "--realtime-middleware-threads", "true"});
  ASSERT_TRUE(flies(*monitor)) << monitor->log();
  const std::vector<int> policies = thread_policies(monitor->pid());
  EXPECT_EQ(policies.front(), SCHED_FIFO);
  EXPECT_GE(std::count(policies.begin(), policies.end(), SCHED_FIFO), 4) << "receivers and events of the middleware";
  EXPECT_GE(std::count(policies.begin(), policies.end(), SCHED_OTHER), 1) << "the reporter stays a normal thread";
}

TEST_F(RealtimeTest, MemoryIsLocked) {
  if (geteuid() != 0) GTEST_SKIP() << "only root may lock memory for sure";
  const auto monitor = start_monitor({"--realtime-lock-memory", "true"});
  ASSERT_TRUE(flies(*monitor)) << monitor->log();
  EXPECT_THAT(status_line(monitor->pid(), "VmLck"), Not(HasSubstr("\t       0 kB")));
  EXPECT_THAT(monitor->log(), Not(HasSubstr("refused")));
}

TEST_F(RealtimeTest, WithoutThePrivilegeItWarnsWithTheRemedyAndRunsOn) {
  // Without capabilities root is what any user is to these calls.
  std::vector<std::string> arguments;
  if (geteuid() == 0) arguments = {"/usr/bin/setpriv", "--bounding-set=-all", "--inh-caps=-all"};
  for (const std::string& argument :
       {monitor_program(), std::string("--monitor-design"), design_file(), std::string("--dds-domain"),
        std::to_string(domain_), std::string("--realtime-policy"), std::string("fifo"),
        std::string("--realtime-lock-memory"), std::string("true")})
    arguments.push_back(argument);
  const Process monitor(arguments);
  ASSERT_TRUE(flies(monitor)) << monitor.log();
  if (monitor.log().find("refused") == std::string::npos) GTEST_SKIP() << "this host grants both to every user";
  EXPECT_THAT(monitor.log(),
              HasSubstr("realtime.policy = fifo with priority 50 was refused (Operation not permitted)"));
  EXPECT_THAT(monitor.log(), HasSubstr("LimitRTPRIO=50"));
  EXPECT_THAT(monitor.log(), HasSubstr("realtime.lock_memory was refused"));
  EXPECT_THAT(monitor.log(), HasSubstr("LimitMEMLOCK=infinity"));
  EXPECT_THAT(thread_policies(monitor.pid()), testing::Each(SCHED_OTHER));
}

TEST_F(RealtimeTest, ABadProcessorListStopsIt) {
  const auto monitor = start_monitor({"--realtime-cpus", "0,2-1"});
  EXPECT_EQ(monitor->wait(seconds(10)), 2);
  EXPECT_THAT(monitor->log(), HasSubstr("'realtime.cpus' is '0,2-1', allowed is a list of processor numbers"));
}

TEST_F(RealtimeTest, AProcessorThatIsNotThereIsAWarning) {
  const auto monitor = start_monitor({"--realtime-cpus", "1023"});
  ASSERT_TRUE(flies(*monitor)) << monitor->log();
  EXPECT_THAT(monitor->log(), HasSubstr("realtime.cpus = 1023 was refused"));
}

}  // namespace
