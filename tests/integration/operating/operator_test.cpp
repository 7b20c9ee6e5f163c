// SPDX-License-Identifier: Apache-2.0
// ehm_command as an operator uses it: orders to a simulator and a monitor in flight, and what it says of them.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/integration/pair/pair.h"

namespace {

using namespace ehm;
using namespace ehm::test;
using testing::HasSubstr;
using testing::Not;

class OperatorTest : public PairTest {
 protected:
  struct Outcome {
    int exit_code = -1;
    std::string said;
  };
  Outcome order(const std::vector<std::string>& words) const {
    std::vector<std::string> arguments{EHM_COMMAND, "--domain", std::to_string(domain_)};
    arguments.insert(arguments.end(), words.begin(), words.end());
    Process tool(arguments);
    const int code = tool.wait(seconds(30)).value_or(-1);
    return {code, tool.log()};
  }
  /// A simulator that needs no monitor, heard.
  std::unique_ptr<Process> fly_alone() {
    auto simulator = std::make_unique<Process>(std::vector<std::string>{
        EHM_ENGINE_SIM, "--dds-domain", std::to_string(domain_), "--run-wait-for-monitors", "1"});
    EXPECT_TRUE(listener_.await([&] { return !listener_.sensors.empty(); })) << simulator->log();
    return simulator;
  }
  void expect_done(const std::vector<std::string>& words, const std::string& said) {
    const Outcome outcome = order(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.said;
    EXPECT_THAT(outcome.said, HasSubstr("source 1: done: " + said));
  }
  void expect_refused(const std::vector<std::string>& words, const std::string& why) {
    const Outcome outcome = order(words);
    EXPECT_EQ(outcome.exit_code, 1) << outcome.said;
    EXPECT_THAT(outcome.said, HasSubstr("source 1: refused: " + why));
  }
  double last_sensor(std::size_t i) const { return listener_.sensors.back().sensor()[i]; }
  static constexpr std::size_t t48 = 6, hpt_efficiency = 6;
};

TEST_F(OperatorTest, OrdersAreCarriedOutAndAnswered) {
  const auto simulator = fly_alone();
  const double t48_k = last_sensor(t48);
  expect_done({"fault", "t48", "bias", "200"}, "T48: bias of +200 K until cleared, from ");
  EXPECT_TRUE(listener_.await([&] { return last_sensor(t48) > t48_k + 100.0; }));
  expect_done({"clear"}, "no fault of any sensor");
  EXPECT_TRUE(listener_.await([&] { return last_sensor(t48) < t48_k + 100.0; }));
  expect_done({"health", "hpt_efficiency", "-0.02", "--add"}, "hpt_efficiency by -0.02 (fraction) at once");
  EXPECT_TRUE(listener_.await(
      [&] { return !listener_.truth.empty() && listener_.truth.rbegin()->second.health()[hpt_efficiency] == -0.02; }));
  expect_done({"flight", "--altitude-m", "10600", "--mach", "0.79"}, "flight at 10600 m, Mach 0.79, ISA +0 K");
  EXPECT_TRUE(listener_.await([&] { return listener_.sensors.back().altitude_m() == 10600.0; }));
  EXPECT_THAT(simulator->log(), HasSubstr("command done: flight at 10600 m, Mach 0.79, ISA +0 K, from "));
}

TEST_F(OperatorTest, ARefusalSaysWhyAndIsAFailure) {
  const auto simulator = fly_alone();
  expect_refused({"demand", "--n1-rpm", "100"}, "value[0] (n1_rpm) is 100, allowed is 500 to 30000");
  expect_refused({"demand", "--thrust-n", "900000"},
                 "value[0] (net_thrust_n) is 900000, but at its limit of fan speed");
  expect_refused({"health", "hpt_flow", "-0.5"}, "hpt_flow after the command is -0.5, allowed is -0.3 to 0.1");
  EXPECT_THAT(simulator->log(), HasSubstr("command refused: hpt_flow after the command is -0.5"));
  const Outcome machine = order({"--json", "demand", "--n1-rpm", "100"});
  EXPECT_EQ(machine.exit_code, 1);
  const auto j = nlohmann::json::parse(machine.said);
  EXPECT_EQ(j["accepted"], false);
  EXPECT_EQ(j["readers"], 1);
  EXPECT_EQ(j["replies"][0]["message"], "value[0] (n1_rpm) is 100, allowed is 500 to 30000");
}

TEST_F(OperatorTest, AWrongNameListsTheNamesThereAre) {
  const auto simulator = fly_alone();
  const Outcome sensor = order({"fault", "T99", "stuck"}), health = order({"health", "HPT_eff", "-0.02"});
  EXPECT_EQ(sensor.exit_code, 2);
  EXPECT_EQ(sensor.said, "ehm_command: the engine has no sensor 'T99'; there are Nf, Nc, P24, T24, Ps30, T30, T48\n");
  EXPECT_EQ(health.exit_code, 2);
  EXPECT_THAT(health.said, HasSubstr("no health parameter 'HPT_eff'; there are fan_efficiency, fan_flow, "));
}

TEST_F(OperatorTest, NobodyListens) {
  const Outcome nobody = order({"--timeout", "1", "--engine", "3", "clear"});
  EXPECT_EQ(nobody.exit_code, 1);
  EXPECT_THAT(nobody.said, HasSubstr("nobody carries out SimCommand of engine 3 on domain " + std::to_string(domain_) +
                                     ", partition '': within 1 s no reader of the topic"));
  const auto simulator = fly_alone();
  const Outcome other = order({"--timeout", "2", "--engine", "3", "clear"});
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_THAT(other.said, HasSubstr("1 reader(s) of the topic, no simulator that describes this engine; there is "
                                    "engine 1; "));
}

TEST_F(OperatorTest, AWrongCommandLineIsTwo) {
  EXPECT_EQ(order({}).exit_code, 2);
  EXPECT_EQ(order({"fault", "T48", "bias"}).exit_code, 2);
  EXPECT_EQ(order({"--engine", "0", "clear"}).exit_code, 2);
  EXPECT_EQ(order({"--timeout", "nan", "clear"}).exit_code, 2);
  const Outcome unsecured = order({"--security", "/nowhere", "clear"});
  EXPECT_EQ(unsecured.exit_code, 2);
  EXPECT_THAT(unsecured.said, HasSubstr("security file /nowhere/identity_ca.pem: no such file"));
}

// A simulator of before there were replies: it reads orders and describes its engine, and that is all.
TEST_F(OperatorTest, WhoCannotAnswerIsSaidToBeSilent) {
  idl::Reader<SimCommand> commands(participant_);
  idl::Writer<EngineDescription> descriptions(participant_);
  EngineDescription d;
  d.engine_id(7);
  d.source_id(4);
  d.role(static_cast<std::uint32_t>(idl::DescriptionRole::source));
  d.schema(idl::schema_version);
  d.sensor_count(1);
  d.sensors()[0].name() = "EGT";
  d.sensors()[0].unit() = "degC";
  descriptions.write(d);
  const Outcome outcome = order({"fault", "EGT", "drift", "0.5", "--engine", "7"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.said, HasSubstr("engine 7: EGT: drift of +0.5 degC/s until cleared\n1 reader of SimCommand"));
  EXPECT_THAT(outcome.said, HasSubstr("source 4: no answer, for it writes no CommandReply"));
  SimCommand heard;
  ASSERT_TRUE(listener_.await([&] { return commands.take(heard); }));
  EXPECT_EQ(heard.channel(), 0u);
  EXPECT_EQ(heard.value()[0], 0.5);
  EXPECT_NE(heard.request(), 0u);
}

TEST_F(OperatorTest, AResetReachesTheMonitor) {
  const auto monitor = start_monitor();
  const auto simulator = start_simulator();
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > 20; }));
  const Outcome outcome = order({"reset"});
  EXPECT_TRUE(listener_.await([&] { return listener_.has_event(idl::EventKind::filter_restart, true); }))
      << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("engine 1: reset of the filter\n1 reader of MonitorCommand"));
  // A monitor that answers makes it 0; one of before there were replies is said to be silent.
  EXPECT_THAT(outcome.said, HasSubstr(outcome.exit_code == 0 ? "monitor 101: done: " : "monitor 101: no answer"));
}

TEST_F(OperatorTest, AResetOfEveryEngineIsAnsweredByWhoHearsIt) {
  idl::Reader<MonitorCommand> commands(participant_);
  idl::Writer<CommandReply> replies(participant_);
  Process tool({EHM_COMMAND, "--domain", std::to_string(domain_), "reset", "--engine", "0"});
  MonitorCommand heard;
  ASSERT_TRUE(listener_.await([&] { return commands.take(heard); })) << tool.log();
  EXPECT_EQ(heard.engine_id(), 0u);
  CommandReply reply;
  reply.source_id(102);
  reply.role(static_cast<std::uint32_t>(idl::DescriptionRole::monitor));
  reply.request(heard.request() + 1);  // another operator's
  replies.write(reply);
  reply.request(heard.request());
  reply.accepted(1);
  reply.message() = "12 filters start anew";
  replies.write(reply);
  EXPECT_EQ(tool.wait(seconds(20)), 0);
  EXPECT_THAT(tool.log(), HasSubstr("all engines: reset of the filters of all engines\n1 reader of MonitorCommand"));
  EXPECT_THAT(tool.log(), HasSubstr("\nmonitor 102: done: 12 filters start anew\n"));
  EXPECT_THAT(tool.log(), Not(HasSubstr("refused")));
}

}  // namespace
