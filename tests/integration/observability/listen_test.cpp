// SPDX-License-Identifier: Apache-2.0
// monitor --listen as a real process, before the example in C with Cyclone DDS, and before sources that are wired
// wrong.

#include <gmock/gmock.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "tests/integration/pair/pair.h"

namespace {

using namespace ehm;
using namespace ehm::test;
using testing::HasSubstr;

class ListenTest : public PairTest {
 protected:
  std::unique_ptr<Process> start_source(const std::string& channels) {
    return std::make_unique<Process>(
        std::vector<std::string>{EHM_SENSOR_SOURCE, "-d", std::to_string(domain_), "-e", "7", channels});
  }
  static std::string shipped_channels() { return EHM_SOURCE_DIR "/deploy/examples/sensor_source_c/jt9d_cruise.csv"; }
};

TEST_F(ListenTest, TheExampleInCIsWiredRightAndFeedsTheMonitor) {
  const auto monitor = start_monitor();
  const auto source = start_source(shipped_channels());
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > 100; })) << source->log();
  const auto listen = start_monitor({"--listen", "--seconds", "1"});
  const auto listen_json = start_monitor({"--listen", "--seconds", "1", "--json"});
  EXPECT_EQ(listen->wait(seconds(20)), 0) << listen->log();
  EXPECT_THAT(listen->log(), testing::AllOf(HasSubstr("engine 7, source 1"), HasSubstr("verdict: OK")));
  EXPECT_EQ(listen_json->wait(seconds(20)), 0);
  const auto report = nlohmann::json::parse(listen_json->log());
  ASSERT_EQ(report["sources"].size(), 1u);
  const auto& heard = report["sources"][0];
  EXPECT_EQ(heard["lost"], 0);
  EXPECT_NEAR(heard["sample_time_source_s"], 0.015, 0.001);
  EXPECT_EQ(heard["sensors"].size(), 7u);
  for (const auto& sensor : heard["sensors"]) EXPECT_LT(std::abs(sensor["deviation"].get<double>()), 1.0) << sensor;
  source->signal(SIGTERM);
  EXPECT_EQ(source->wait(seconds(10)), 0) << source->log();
  // Everything at trim: the engine is as new, and the estimate says so within its sigma.
  const EngineHealth& last = listener_.health.back();
  for (std::size_t i = 0; i < last.health_count(); ++i)
    EXPECT_LT(std::abs(last.health()[i]), 2.0 * last.sigma_total()[i]) << i;
}

TEST_F(ListenTest, SwappedChannelsAreNamed) {
  const auto source = start_source(file("channels.csv",
                                        "kind,name,unit,trim,sigma\n"
                                        "flight,altitude_m,m,10668,0\nflight,mach,,0.8,0\n"
                                        "actuator,fuel_flow,kg/s,0.822579,0\nactuator,VSV,deg,0,0\n"
                                        "actuator,VBV,fraction,0,0\n"
                                        "actuator,customer_bleed,kg/s,0,0\nactuator,power_offtake,W,0,0\n"
                                        "sensor,Nf,rpm,3648.11,9.12\nsensor,Nc,rpm,7398.86,18.5\n"
                                        "sensor,P24,Pa,147310,737\nsensor,T24,K,669.311,5.02\n"
                                        "sensor,Ps30,Pa,777.689,3.89\nsensor,T30,K,389.99,2.92\n"
                                        "sensor,T48,K,752.75,7.69\n"));
  const auto listen = start_monitor({"--listen", "--seconds", "1"});
  EXPECT_EQ(listen->wait(seconds(20)), 1);
  EXPECT_THAT(listen->log(),
              testing::AllOf(HasSubstr("ERROR: sensor T24"), HasSubstr("swapped with T30?"),
                             HasSubstr("swapped with T24?"), HasSubstr("it looks like kPa, Pa is needed"),
                             HasSubstr("it looks like degC, K is needed"), HasSubstr("verdict: NOT OK")));
}

TEST_F(ListenTest, SaysWhichPolicyKeepsAWriterOut) {
  auto* topic = participant_.topic("EngineSensors", eprosima::fastdds::dds::TypeSupport(new EngineSensorsPubSubType()));
  auto qos = idl::writer_qos(idl::Delivery::stream, false, {});
  qos.reliability().kind = eprosima::fastdds::dds::BEST_EFFORT_RELIABILITY_QOS;
  auto* writer = participant_.publisher()->create_datawriter(topic, qos);
  ASSERT_NE(writer, nullptr);
  const auto listen = start_monitor({"--listen", "--seconds", "0.1"});
  EXPECT_EQ(listen->wait(seconds(20)), 1);
  EXPECT_THAT(listen->log(), testing::AllOf(HasSubstr("EngineSensors"), HasSubstr("QoS reliability")));
  participant_.publisher()->delete_datawriter(writer);
}

TEST_F(ListenTest, NobodyThereIsSaidWithTheRemedy) {
  const auto listen = start_monitor({"--listen", "--seconds", "0.1", "--dds-partition", "fleet/none"});
  EXPECT_EQ(listen->wait(seconds(20)), 1);
  EXPECT_THAT(listen->log(), HasSubstr("no writer of EngineSensors on domain " + std::to_string(domain_) +
                                       ", partition 'fleet/none': check"));
  const auto alone = start_monitor({"--seconds", "3"});
  EXPECT_EQ(alone->wait(seconds(20)), 2);
}

}  // namespace
