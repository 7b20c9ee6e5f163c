// SPDX-License-Identifier: Apache-2.0
// Who may feed an engine, and what is said of sources: second writers, deadline, liveliness, QoS that excludes, floods
// of bad samples. What the monitor does in each case: deploy/docs/wire_behaviour.md.

#include <algorithm>
#include <cmath>
#include <csignal>

#include "tests/integration/observability/stopped_thread.h"
#include "tests/integration/pair/pair.h"

namespace {

using namespace ehm;
using namespace ehm::test;

class SourceTest : public PairTest {
 protected:
  const MonitorStatus& status() const { return listener_.status.back(); }
  bool logs(const Process& process, const std::string& text) const {
    return process.log().find(text) != std::string::npos;
  }
};

TEST_F(SourceTest, TheFirstOfTwoSimulatorsIsFollowedUntilItIsSilent) {
  const auto monitor = start_monitor({"--monitor-status-period-s", "0.1"});
  const auto first = start_simulator();
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > 50; }));
  // The likeliest mistake: the same command twice, so that even the source ids are equal.
  const auto second = start_simulator({"--run-seed", "5"});
  ASSERT_TRUE(listener_.await([&] { return !listener_.status.empty() && status().samples_foreign() > 100; }));
  EXPECT_EQ(status().filter_restarts(), 0u);
  EXPECT_EQ(status().samples_lost(), 0u);
  EXPECT_EQ(status().samples_received(), status().samples_processed() + status().samples_foreign());
  const HealthEvent* said = listener_.find_event(idl::EventKind::second_source, true);
  ASSERT_NE(said, nullptr);
  EXPECT_TRUE(logs(*monitor, "another writer also sends samples of this engine as source 1; the first is listened to"))
      << monitor->log();

  const std::size_t estimates = listener_.health.size();
  first->signal(SIGKILL);
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > estimates + 100; }));
  EXPECT_TRUE(listener_.has_event(idl::EventKind::second_source, false));
  EXPECT_TRUE(listener_.has_event(idl::EventKind::input_lost, true));
  const std::uint64_t foreign = status().samples_foreign();
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > estimates + 200; }));
  EXPECT_EQ(status().samples_foreign(), foreign);  // the second is the one that is followed now
}

TEST_F(SourceTest, OnlyTheNamedSourceIsFollowedHoweverLongItIsSilent) {
  const auto monitor = start_monitor({"--monitor-status-period-s", "0.1", "--checks-source-id", "1"});
  const auto stranger = start_simulator({"--engine-source-id", "2"});
  ASSERT_TRUE(listener_.await([&] { return !listener_.status.empty() && status().samples_foreign() > 100; }));
  EXPECT_TRUE(listener_.health.empty());
  EXPECT_TRUE(logs(*monitor, "source 2 also sends samples of this engine; source 1 is listened to")) << monitor->log();
  const auto named = start_simulator({"--run-seed", "5"});
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > 50; }));
  // Once, however often the silent engine was looked at.
  const auto raised = [&] {
    return std::count_if(listener_.events.begin(), listener_.events.end(), [](const HealthEvent& e) {
      return e.kind() == static_cast<std::uint32_t>(idl::EventKind::second_source) && e.raised();
    });
  };
  EXPECT_EQ(raised(), 1);
  const std::uint64_t processed = status().samples_processed();
  named->signal(SIGKILL);
  const std::uint64_t foreign = status().samples_foreign();
  ASSERT_TRUE(listener_.await([&] { return status().samples_foreign() > foreign + 100; }));
  EXPECT_TRUE(listener_.has_event(idl::EventKind::input_lost, true));
  const std::size_t estimates = listener_.health.size();
  ASSERT_TRUE(listener_.await([&] { return status().samples_foreign() > foreign + 200; }));
  EXPECT_EQ(listener_.health.size(), estimates);
  EXPECT_GE(status().samples_processed(), processed);
}

TEST_F(SourceTest, DeadlineAndLivelinessAreWatchedWhereAskedFor) {
  const auto monitor =
      start_monitor({"--dds-input-deadline-s", "0.1", "--dds-input-lease-s", "1", "--monitor-status-period-s", "0.1"});
  const auto simulator = start_simulator();
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > 20; }));
  EXPECT_FALSE(listener_.has_event(idl::EventKind::input_liveliness, true));
  simulator->signal(SIGSTOP);
  ASSERT_TRUE(listener_.await([&] { return listener_.has_event(idl::EventKind::input_deadline, true); }));
  EXPECT_EQ(listener_.find_event(idl::EventKind::input_deadline, true)->engine_id(), 1u);
  ASSERT_TRUE(listener_.await([&] { return listener_.has_event(idl::EventKind::input_liveliness, true); }));
  EXPECT_EQ(listener_.find_event(idl::EventKind::input_liveliness, true)->engine_id(), 0u);  // a matter of the writer
  ASSERT_TRUE(listener_.await([&] { return status().input_liveliness_losses() == 1; }));
  EXPECT_GE(status().input_deadline_misses(), 1u);
  simulator->signal(SIGCONT);
  EXPECT_TRUE(listener_.await([&] {
    return listener_.has_event(idl::EventKind::input_deadline, false) &&
           listener_.has_event(idl::EventKind::input_liveliness, false);
  }));
}

/// A writer as a foreign vendor's defaults make it: no deadline, no lease.
class PlainWriter {
 public:
  explicit PlainWriter(idl::Participant& participant) : publisher_(participant.publisher()) {
    auto* topic =
        participant.topic("EngineSensors", eprosima::fastdds::dds::TypeSupport(new EngineSensorsPubSubType()));
    writer_ = publisher_->create_datawriter(topic, eprosima::fastdds::dds::DATAWRITER_QOS_DEFAULT);
  }
  ~PlainWriter() { publisher_->delete_datawriter(writer_); }
  PlainWriter(const PlainWriter&) = delete;
  PlainWriter& operator=(const PlainWriter&) = delete;
  int matched() const {
    eprosima::fastdds::dds::PublicationMatchedStatus status;
    writer_->get_publication_matched_status(status);
    return status.current_count;
  }

 private:
  eprosima::fastdds::dds::Publisher* publisher_;
  eprosima::fastdds::dds::DataWriter* writer_;
};

TEST_F(SourceTest, APlainWriterIsHeardByDefault) {
  const PlainWriter writer(participant_);
  const auto monitor = start_monitor();
  EXPECT_TRUE(listener_.await([&] { return writer.matched() == 2; }));
  EXPECT_FALSE(listener_.has_event(idl::EventKind::incompatible_qos, true));
}

TEST_F(SourceTest, AWriterThatDoesNotOfferWhatIsAskedForIsExcludedAndThePolicyNamed) {
  const PlainWriter writer(participant_);
  const auto monitor = start_monitor({"--dds-input-deadline-s", "0.1"});
  ASSERT_TRUE(listener_.await([&] { return listener_.has_event(idl::EventKind::incompatible_qos, true); }));
  const HealthEvent* event = listener_.find_event(idl::EventKind::incompatible_qos, true);
  EXPECT_EQ(event->engine_id(), 0u);
  EXPECT_STREQ(event->message().c_str(),
               "topic EngineSensors: a remote writer and this one exclude each other by QoS deadline; no data flows "
               "between them");
  EXPECT_EQ(writer.matched(), 1);  // our own listener only
}

/// Writes messages whose encapsulation is not of any kind, or that end too soon.
class GarbledType : public EngineSensorsPubSubType {
 public:
  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override {
    const bool done = EngineSensorsPubSubType::serialize(data, payload);
    if (++count_ % 2 == 0) payload->length = 40;
    payload->data[0] = static_cast<unsigned char>(count_);
    return done;
  }

 private:
  int count_ = 0;
};

TEST_F(SourceTest, MessagesThatAreNotOfTheTypeDoNotEndTheMonitor) {
  auto monitor = start_monitor({"--monitor-status-period-s", "0.1"});
  const auto simulator = start_simulator();
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > 50; }));
  {
    idl::Participant stranger(options(domain_));
    auto* topic = stranger.topic("EngineSensors", eprosima::fastdds::dds::TypeSupport(new GarbledType()));
    auto* writer = stranger.publisher()->create_datawriter(
        topic, idl::writer_qos(idl::Delivery::stream, false, idl::Redundancy{}));
    eprosima::fastdds::dds::PublicationMatchedStatus matched;
    ASSERT_TRUE(listener_.await([&] {
      writer->get_publication_matched_status(matched);
      return matched.current_count == 2;
    }));
    EngineSensors sample;
    sample.engine_id(1);
    for (int i = 0; i < 600; ++i) writer->write(&sample);  // more than any history holds
    writer->wait_for_acknowledgments(eprosima::fastrtps::Duration_t(5, 0));
    stranger.publisher()->delete_datawriter(writer);
  }
  const std::size_t estimates = listener_.health.size();
  EXPECT_TRUE(listener_.await([&] { return listener_.health.size() > estimates + 50; })) << monitor->log();
  EXPECT_TRUE(monitor->running());
  EXPECT_EQ(status().samples_lost(), 0u);
}

TEST_F(SourceTest, MessagesThatAreNotOfTheTypePushNoSampleOutWhileTheCycleIsHeldUp) {
  const auto monitor = start_monitor({"--monitor-status-period-s", "0.1"});
  const auto simulator = start_simulator();
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > 50; }));
  idl::Participant stranger(options(domain_));
  auto* topic = stranger.topic("EngineSensors", eprosima::fastdds::dds::TypeSupport(new GarbledType()));
  auto* writer =
      stranger.publisher()->create_datawriter(topic, idl::writer_qos(idl::Delivery::stream, false, idl::Redundancy{}));
  eprosima::fastdds::dds::PublicationMatchedStatus matched;
  ASSERT_TRUE(listener_.await([&] {
    writer->get_publication_matched_status(matched);
    return matched.current_count == 2;
  }));
  // The cycle is the main thread. Where it is stopped within a call of the middleware, the middleware's threads wait for
  // it and acknowledge nothing: a first message shows that, and it is stopped again, elsewhere.
  EngineSensors sample;
  sample.engine_id(1);
  const auto acknowledged_within = [&](const eprosima::fastrtps::Duration_t& limit) {
    return writer->wait_for_acknowledgments(limit) == eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK;
  };
  const auto flood_while_held = [&] {
    const StoppedThread held_up(monitor->pid());
    writer->write(&sample);
    if (!acknowledged_within({0, 300'000'000})) return false;
    const std::size_t sent = listener_.sensors.size();
    EXPECT_TRUE(listener_.await([&] { return listener_.sensors.size() > sent + 20; }));
    for (int i = 0; i < 600; ++i) writer->write(&sample);
    return acknowledged_within({1, 0});
  };
  bool acknowledged = false;
  for (int tries = 0; tries < 5 && !(acknowledged = flood_while_held()); ++tries) {
    const std::size_t caught_up = listener_.health.size() + 60;  // or it would be met in its backlog
    ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > caught_up; }));
  }
  EXPECT_TRUE(acknowledged);
  const std::size_t estimates = listener_.health.size();
  EXPECT_TRUE(listener_.await([&] { return listener_.health.size() > estimates + 50; })) << monitor->log();
  EXPECT_EQ(status().samples_lost(), 0u);
  EXPECT_EQ(status().filter_restarts(), 0u);
  stranger.publisher()->delete_datawriter(writer);
}

TEST_F(SourceTest, AFloodOfBadSamplesDoesNotDisturbTheSource) {
  const auto monitor = start_monitor({"--monitor-status-period-s", "0.1"});
  const auto simulator = start_simulator();
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > 50; }));
  Process hostile({EHM_HOSTILE, "--domain", std::to_string(domain_), "--rate-hz", "500", "--duration-s", "4"});
  ASSERT_TRUE(listener_.await([&] { return !hostile.running(); }));
  EXPECT_EQ(hostile.wait(seconds(1)), 0) << hostile.log();
  simulator->signal(SIGINT);
  EXPECT_EQ(simulator->wait(seconds(5)), 0);
  ASSERT_TRUE(listener_.await([&] { return status().level() == static_cast<std::uint32_t>(idl::StatusLevel::stale); }));

  const MonitorStatus& s = status();
  EXPECT_EQ(s.samples_processed(), listener_.truth.size());  // one truth for each sample of the simulator
  EXPECT_EQ(listener_.health.size(), s.samples_processed());
  EXPECT_GT(s.samples_foreign(), 100u);
  EXPECT_GT(s.samples_malformed(), 100u);
  EXPECT_GT(s.unknown_engine_samples(), 20u);
  EXPECT_EQ(s.samples_received(), s.samples_processed() + s.samples_foreign() + s.samples_malformed());
  EXPECT_EQ(s.samples_lost() + s.samples_withheld() + s.filter_restarts(), 0u);
  EXPECT_FALSE(listener_.has_event(idl::EventKind::sensor_fault, true));
  EXPECT_TRUE(logs(*monitor, "a sample of source 666 cannot be used: schema")) << monitor->log();
}

TEST_F(SourceTest, ASourceOfNothingButBadSamplesIsSurvived) {
  const auto monitor = start_monitor({"--monitor-status-period-s", "0.1"});
  Process hostile({EHM_HOSTILE, "--domain", std::to_string(domain_), "--rate-hz", "1000", "--duration-s", "3",
                   "--wait-for-readers", "2", "--seed", "3"});
  ASSERT_TRUE(listener_.await([&] { return !hostile.running(); }));
  EXPECT_EQ(hostile.wait(seconds(1)), 0) << hostile.log();
  ASSERT_TRUE(listener_.await([&] { return !listener_.status.empty() && status().samples_received() > 1000; }));
  for (const auto& h : listener_.health)
    for (std::size_t i = 0; i < h.health_count(); ++i) {
      ASSERT_TRUE(std::isfinite(h.health()[i])) << h.sequence_number();
      ASSERT_GT(h.sigma_total()[i], 0.0);
    }
  const auto simulator = start_simulator();
  EXPECT_TRUE(listener_.await([&] { return listener_.health.size() > 100; }));  // and the true source is welcome
  monitor->signal(SIGTERM);
  EXPECT_EQ(monitor->wait(seconds(5)), 0);
}

}  // namespace
