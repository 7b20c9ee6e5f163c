// SPDX-License-Identifier: Apache-2.0
// Who gets a filter, who gives it back, and who may give orders how often.

#include <csignal>
#include <map>
#include <optional>
#include <set>

#include "tests/integration/pair/engine_samples.h"
#include "tests/integration/pair/pair.h"

namespace {

using namespace ehm;
using namespace ehm::test;

class MembershipTest : public PairTest {
 protected:
  void start(std::vector<std::string> flags) {
    flags.insert(flags.end(), {"--monitor-status-period-s", "0.1"});
    monitor_ = start_monitor(flags);
    ASSERT_TRUE(listener_.await([&] { return writer_.matched() == 2 && commands_.matched() == 1; }));
  }
  /// Sends samples until the condition holds.
  bool send_until(EngineSamples& samples, const std::function<bool()>& condition) {
    return listener_.await([&] {
      writer_.write(samples.next());
      return condition();
    });
  }
  bool estimated(std::uint32_t engine) const {
    return std::any_of(listener_.health.begin(), listener_.health.end(),
                       [&](const EngineHealth& h) { return h.engine_id() == engine; });
  }
  /// The latest; all zero while there is none.
  MonitorStatus status() const { return listener_.status.empty() ? MonitorStatus() : listener_.status.back(); }
  MonitorCommand reset(std::uint32_t engine, std::uint32_t request) const {
    MonitorCommand command;
    command.engine_id(engine);
    command.schema(idl::schema_version);
    command.kind(static_cast<std::uint32_t>(idl::MonitorCommandKind::reset));
    command.request(request);
    return command;
  }
  /// The answer to the request, once it has come.
  std::optional<CommandReply> reply(std::uint32_t request) {
    CommandReply latest;
    EXPECT_TRUE(listener_.await([&] {
      while (replies_.take(latest)) answers_[latest.request()] = latest;
      return answers_.contains(request);
    })) << request;
    return answers_.contains(request) ? std::optional(answers_[request]) : std::nullopt;
  }

  std::unique_ptr<Process> monitor_;
  idl::Writer<EngineSensors> writer_{participant_};
  idl::Writer<MonitorCommand> commands_{participant_};
  idl::Reader<CommandReply> replies_{participant_};
  std::map<std::uint32_t, CommandReply> answers_;  ///< by request
};

TEST_F(MembershipTest, AStrayMessageTakesNoFilter) {
  start({"--monitor-max-engines", "2"});
  for (std::uint32_t engine = 100; engine < 116; ++engine) {
    EngineSamples samples(design_file(), engine);
    EngineSensors stray = samples.next();
    if (engine % 3 == 0) stray.schema(77);
    if (engine % 3 == 1) stray.sensor_count(3);
    if (engine % 3 == 2) stray.sensor_valid(0);
    writer_.write(stray);
  }
  EngineSamples one(design_file(), 1), two(design_file(), 2);
  EXPECT_TRUE(send_until(one, [&] { return estimated(1); }));
  EXPECT_TRUE(send_until(two, [&] { return estimated(2); }));
  EXPECT_TRUE(listener_.await([&] { return status().unknown_engine_samples() == 16; }));
  EXPECT_NE(monitor_->log().find("engine 100: a sample of source 9 cannot be used"), std::string::npos)
      << monitor_->log();
}

TEST_F(MembershipTest, AnEngineThatIsSilentForLongGivesItsFilterBack) {
  start({"--monitor-max-engines", "1", "--monitor-forget-engine-s", "0.5"});
  EngineSamples one(design_file(), 1), two(design_file(), 2);
  ASSERT_TRUE(send_until(one, [&] { return estimated(1); }));
  writer_.write(two.next());
  EXPECT_TRUE(listener_.await([&] { return status().unknown_engine_samples() == 1; }));
  ASSERT_TRUE(listener_.await([&] { return listener_.has_event(idl::EventKind::engine_left, true); }));
  EXPECT_EQ(listener_.find_event(idl::EventKind::engine_left, true)->engine_id(), 1u);
  EXPECT_TRUE(listener_.has_event(idl::EventKind::input_lost, false)) << "what it had raised ends with it";
  ASSERT_TRUE(send_until(two, [&] { return estimated(2); }));
  // The first is back when the second has gone, from a cold start and with counters of its own.
  ASSERT_TRUE(listener_.await([&] {
    return std::count_if(listener_.events.begin(), listener_.events.end(), [](const HealthEvent& e) {
             return e.kind() == static_cast<std::uint32_t>(idl::EventKind::engine_left) && e.raised() == 1;
           }) == 2;
  }));
  listener_.health.clear();
  ASSERT_TRUE(send_until(one, [&] { return estimated(1); }));
  EXPECT_TRUE(listener_.health.front().flags() & idl::estimate_flag::converging);
  EXPECT_TRUE(listener_.await([&] { return listener_.has_event(idl::EventKind::engine_left, false); }));
}

TEST_F(MembershipTest, ANamedEngineKeepsItsFilter) {
  const std::string config =
      file("named.toml", "[monitor]\nmax_engines = 1\nforget_engine_s = 0.3\n[[engine]]\nids = [1]\ndesign = \"" +
                             design_file() + "\"\n");
  start({"--config", config, "--monitor-design", ""});
  EngineSamples one(design_file(), 1);
  ASSERT_TRUE(send_until(one, [&] { return estimated(1); }));
  ASSERT_TRUE(listener_.await([&] { return status().age_s() > 1.0; }));
  EXPECT_FALSE(listener_.has_event(idl::EventKind::engine_left, true));
}

TEST_F(MembershipTest, KeysAreBounded) {
  // A reader of its own: what it keeps is what the monitor's keeps.
  idl::Participant elsewhere(options(domain_));
  idl::Reader<EngineSensors> reader(elsewhere);
  idl::Participant strangers(options(domain_));
  idl::Writer<EngineSensors> stranger(strangers);
  ASSERT_TRUE(listener_.await([&] { return stranger.matched() == 2 && writer_.matched() == 2; }));
  std::set<std::uint32_t> heard;
  EngineSensors sample;
  EngineSamples samples(design_file(), 1);
  std::uint32_t next = 1000;
  const auto take = [&] {
    while (reader.take(sample)) heard.insert(sample.engine_id());
  };
  listener_.await([&] {  // until the reader refuses
    for (int i = 0; i < 100; ++i, ++next) {
      EngineSensors s = samples.next();
      s.engine_id(next);
      stranger.write(s);
    }
    take();
    return next > 1000 + 6000;
  });
  take();
  EXPECT_GT(heard.size(), 4000u);
  EXPECT_LE(heard.size(), 4096u);
}

TEST_F(MembershipTest, AFloodOfResetsIsRefusedAndAnswered) {
  start({"--monitor-max-engines", "1"});
  EngineSamples one(design_file(), 1);
  ASSERT_TRUE(send_until(one, [&] { return estimated(1); }));
  for (std::uint32_t request = 1; request <= 20; ++request) commands_.write(reset(0, request));
  EXPECT_EQ(reply(1)->accepted(), 1u);
  const auto refused = reply(20);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->accepted(), 0u);
  EXPECT_EQ(refused->role(), static_cast<std::uint32_t>(idl::DescriptionRole::monitor));
  EXPECT_STREQ(refused->message().c_str(), "1 of 1 engines were reset less than 2 s ago");
  ASSERT_TRUE(listener_.await([&] { return listener_.has_event(idl::EventKind::command_flood, true); }));
  ASSERT_TRUE(send_until(one, [&] { return status().level() == static_cast<std::uint32_t>(idl::StatusLevel::warn); }));
  EXPECT_EQ(status().filter_restarts(), 1u);
}

TEST_F(MembershipTest, AnOrderThatCannotBeCarriedOutIsAnswered) {
  start({"--monitor-max-engines", "1"});
  commands_.write(reset(9, 71));
  EXPECT_STREQ(reply(71)->message().c_str(), "engine 9 is not served here");
  MonitorCommand odd = reset(1, 72);
  odd.kind(99);
  commands_.write(odd);
  EXPECT_STREQ(reply(72)->message().c_str(), "kind 99 is unknown, 1 is a reset, from 256 on estimators are published");
  odd = reset(1, 73);
  odd.schema(5);
  commands_.write(odd);
  EXPECT_EQ(reply(73)->accepted(), 0u);
}

TEST_F(MembershipTest, TwoMonitorsWithOneIdentityAreNoticedByBoth) {
  start({});
  auto second = start_monitor({"--metrics-listen", ""});
  ASSERT_TRUE(listener_.await([&] { return listener_.has_event(idl::EventKind::second_monitor, true); }));
  EXPECT_TRUE(listener_.await([&] {
    return second->log().find("another monitor of this domain has monitor.source_id = 101 too") != std::string::npos;
  }));
  second->signal(SIGTERM);
  EXPECT_EQ(second->wait(seconds(5)), 0);
  EXPECT_TRUE(listener_.await([&] { return listener_.has_event(idl::EventKind::second_monitor, false); }));
}

TEST_F(MembershipTest, WithoutDescriptorsTheMonitorSaysSoAndDoesNotStart) {
  Process deaf(
      {"/bin/sh", "-c",
       "ulimit -n 12; exec " + monitor_program() + " --monitor-design " + design_file() + " --metrics-listen ''"});
  const auto code = deaf.wait(seconds(10));
  ASSERT_TRUE(code);
  EXPECT_EQ(*code, 2);
  EXPECT_NE(deaf.log().find("this process may have 12 file descriptors"), std::string::npos) << deaf.log();
}

}  // namespace
