// SPDX-License-Identifier: Apache-2.0
// SIGHUP in flight: what is valid is taken between two samples, what is not is refused by name, and nothing is lost.

#include <sys/stat.h>

#include <csignal>
#include <fstream>

#include "tests/integration/pair/pair.h"
#include "tests/temporary_folder.h"

namespace {

using namespace ehm;
using namespace ehm::test;

class ReloadTest : public PairTest {
 protected:
  void configure(const std::string& text) {
    std::ofstream(folder_.path("monitor.toml")) << "[monitor]\nstatus_period_s = 0.1\n" << text;
  }
  void fly() {
    monitor_ = start_monitor({"--config", folder_.path("monitor.toml"), "--metrics-listen", ""});
    simulator_ = start_simulator();
    ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > 100 && !listener_.status.empty(); }));
  }
  /// The latest event of a reload, once another one has come.
  HealthEvent reload() {
    const auto count = [&] {
      return std::count_if(listener_.events.begin(), listener_.events.end(), [](const HealthEvent& e) {
        return e.kind() == static_cast<std::uint32_t>(idl::EventKind::configuration);
      });
    };
    const auto before = count();
    monitor_->signal(SIGHUP);
    EXPECT_TRUE(listener_.await([&] { return count() > before; })) << monitor_->log();
    return *std::find_if(listener_.events.rbegin(), listener_.events.rend(), [](const HealthEvent& e) {
      return e.kind() == static_cast<std::uint32_t>(idl::EventKind::configuration);
    });
  }
  std::uint64_t restarts() {
    listener_.status.clear();
    EXPECT_TRUE(listener_.await([&] { return !listener_.status.empty(); }));
    return listener_.status.back().filter_restarts();
  }
  void expect_no_gap() {
    for (std::size_t i = 1; i < listener_.health.size(); ++i)
      ASSERT_EQ(listener_.health[i].sequence_number(), listener_.health[i - 1].sequence_number() + 1);
  }
  TemporaryFolder folder_;
  std::unique_ptr<Process> monitor_, simulator_;
};

TEST_F(ReloadTest, NothingChangedKeepsEveryFilter) {
  configure("");
  fly();
  EXPECT_EQ(reload().raised(), 0u);
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > 300; }));
  EXPECT_EQ(restarts(), 0u);
  EXPECT_EQ(listener_.status.back().reloads(), 1u);
  expect_no_gap();
}

TEST_F(ReloadTest, ChangedOptionsStartTheFilterAnewAndSaySo) {
  configure("");
  fly();
  configure("[checks]\ngate_sigma = 6.0\n");
  EXPECT_EQ(reload().raised(), 0u);
  ASSERT_TRUE(listener_.await([&] { return listener_.has_event(idl::EventKind::filter_restart, true); }));
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > 300; }));
  EXPECT_TRUE(listener_.health.back().flags() & idl::estimate_flag::converging);
  EXPECT_GT(listener_.status.back().samples_received(), 100u);  // it goes on counting
  expect_no_gap();
}

TEST_F(ReloadTest, WhatIsWrongLeavesTheOldOneFlying) {
  configure("");
  fly();
  const auto refused = [&](const std::string& text) {
    configure(text);
    const HealthEvent e = reload();
    EXPECT_EQ(e.raised(), 1u);
    return std::string(e.message().c_str());
  };
  EXPECT_NE(refused("[checks]\ngate_sigma = 600.0\n").find("checks.gate_sigma"), std::string::npos);
  EXPECT_NE(refused("[checks\n").find("monitor.toml"), std::string::npos);
  EXPECT_NE(refused("[dds]\npartition = \"fleet/b\"\n").find("'dds.partition'"), std::string::npos);
  EXPECT_NE(refused("max_engines = 2\n").find("can only grow"), std::string::npos);
  EXPECT_NE(refused("[[engine]]\nids = [1]\ndesign = \"absent.json\"\n").find("absent.json"), std::string::npos);
  // What is no file neither blocks the reload nor fills the memory.
  const std::string pipe = folder_.path("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_NE(refused("[[engine]]\nids = [1]\ndesign = \"" + pipe + "\"\n").find("pipe: is a pipe"), std::string::npos);
  EXPECT_NE(refused("[[engine]]\nids = [1]\ndesign = \"/dev/zero\"\n").find("is a device"), std::string::npos);
  EXPECT_NE(refused("[[engine]]\nids = [1]\ndesign = \"" + design_file() + "\"\nshadow = \"ekf\"\n")
                .find("'shadow' of the [[engine]] tables"),
            std::string::npos);
  EXPECT_EQ(restarts(), 0u);
  EXPECT_EQ(listener_.status.back().reloads_refused(), 8u);
  EXPECT_EQ(listener_.status.back().reloads(), 0u);
  expect_no_gap();
  configure("");
  EXPECT_EQ(reload().raised(), 0u);  // and a right one is taken afterwards
}

}  // namespace
