// SPDX-License-Identifier: Apache-2.0
// Cyclone DDS and the services understand each other on every topic, both ways.

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <fstream>
#include <sstream>

#include "tests/integration/pair/pair.h"

namespace {

using namespace ehm;
using namespace ehm::test;

class CycloneTest : public PairTest {};

TEST_F(CycloneTest, ReadsEveryTopic) {
  idl::Writer<SimCommand> sim_commands(participant_);
  idl::Writer<MonitorCommand> monitor_commands(participant_);
  Process peer({EHM_CYCLONE_PEER, "listen", std::to_string(domain_), "8"});
  ASSERT_TRUE(listener_.await([&] { return sim_commands.matched() == 1 && monitor_commands.matched() == 1; }));
  const auto monitor = start_monitor();
  const auto simulator = start_simulator({"--run-wait-for-monitors", "3"});
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > 50 && sim_commands.matched() == 2; }));
  SimCommand fault;  // makes an event, and is a command itself
  fault.engine_id(1);
  fault.schema(idl::schema_version);
  fault.kind(static_cast<std::uint32_t>(idl::SimCommandKind::sensor_fault));
  fault.channel(4);
  fault.fault(static_cast<std::uint32_t>(idl::SensorFaultKind::dropout));
  sim_commands.write(fault);
  MonitorCommand reset;
  reset.engine_id(99);
  reset.schema(idl::schema_version);
  reset.kind(1);
  monitor_commands.write(reset);
  ASSERT_EQ(peer.wait(seconds(20)), 0) << peer.log();

  std::map<std::string, double> heard;
  std::istringstream lines(peer.log());
  std::string name;
  for (double value; lines >> name >> value;) heard[name] = value;
  for (const char* stream : {"EngineSensors", "EngineHealth", "EngineAuxiliary", "EngineResiduals", "EngineTruth"})
    EXPECT_GT(heard[stream], 50.0) << stream;
  for (const char* rare : {"EngineDescription", "MonitorStatus", "HealthEvent", "SimCommand", "MonitorCommand"})
    EXPECT_GE(heard[rare], 1.0) << rare;
  EXPECT_GE(heard["EngineDescription"], 2.0);  // of the source and of the monitor
  EXPECT_GT(heard["sigma_total[0]"], 0.001);
  EXPECT_NEAR(heard["thrust"], listener_.auxiliary.back().auxiliary()[2], 0.1 * heard["thrust"]);
}

TEST_F(CycloneTest, FeedsTheMonitor) {
  const auto monitor = start_monitor({"--monitor-status-period-s", "0.1"});
  const auto design = nlohmann::json::parse(std::ifstream(design_file()));
  std::vector<std::string> arguments{EHM_CYCLONE_PEER, "feed", std::to_string(domain_), "200",
                                     design["model"]["controls"][0]["trim"].dump()};
  for (const auto& sensor : design["model"]["sensors"]) arguments.push_back(sensor["trim"].dump());
  ASSERT_TRUE(listener_.await([&] { return !listener_.status.empty() || monitor->running(); }));
  Process peer(arguments);
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > 100; })) << peer.log();
  EXPECT_EQ(listener_.health.back().engine_id(), 7u);
  EXPECT_EQ(peer.wait(seconds(20)), 0) << peer.log();
  // Sensors at trim: the engine is as new, and the estimate says so within its sigma.
  for (std::size_t i = 0; i < listener_.health.back().health_count(); ++i)
    EXPECT_LT(std::abs(listener_.health.back().health()[i]), listener_.health.back().sigma_total()[i]);
}

}  // namespace
