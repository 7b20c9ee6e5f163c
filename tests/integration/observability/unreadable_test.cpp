// SPDX-License-Identifier: Apache-2.0
// Peers whose data can never be read, or that can never read ours: real processes of Cyclone DDS with an IDL or a data
// representation that is not ours, and a Fast DDS writer with another name of the type. The monitor and --listen name
// participant, topic and reason, once a peer.

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/integration/observability/watched_pair.h"

namespace {

using namespace ehm;
using namespace ehm::test;
using testing::AllOf;
using testing::HasSubstr;

class UnreadableTest : public WatchedPairTest {
 protected:
  /// The middleware of the test itself complains of each message that is too long.
  UnreadableTest() {
    idl::hear_middleware([](const idl::MiddlewareMessage&) {}, idl::MiddlewareLevel::errors);
  }
  /// `odd`: "" or the name of an odd IDL; sends at once and without end once a reader matches.
  std::unique_ptr<Process> start_peer(const std::string& odd, const std::string& mode = "feed") {
    return std::make_unique<Process>(std::vector<std::string>{EHM_CYCLONE_PEER + odd, mode, std::to_string(domain_),
                                                              mode == "listen" ? "60" : "100000", "0.82", "3648"});
  }
  std::vector<std::string> said(bool raised) const {
    std::vector<std::string> messages;
    for (const HealthEvent& e : listener_.events)
      if (e.kind() == static_cast<std::uint32_t>(idl::EventKind::unreadable_peer) && (e.raised() != 0) == raised)
        messages.emplace_back(e.message().c_str());
    return messages;
  }
  /// The message of the only peer there is, once it is there.
  std::string only_message() {
    EXPECT_TRUE(listener_.await([&] { return !said(true).empty(); }));
    EXPECT_EQ(said(true).size(), 1u);
    return said(true).empty() ? "" : said(true).front();
  }
};

// Address and participant as the peer announces them: Cyclone DDS gives itself no name.
const auto writer_of_somebody =
    AllOf(HasSubstr("topic EngineSensors: the writer of participant '' at UDPv4:["), HasSubstr(" can never be read: "));

TEST_F(UnreadableTest, Xcdr2IsNamedAndItsEndIsSaid) {
  const auto monitor = start_watched_monitor();
  auto peer = start_peer("", "feed-xcdr2");
  const std::string message = only_message();
  EXPECT_THAT(message, AllOf(writer_of_somebody, HasSubstr("it writes XCDR2, needed is XCDR1")));
  EXPECT_THAT(monitor->log(), HasSubstr(message));
  const Exposition metrics = scrape();
  EXPECT_EQ(metrics.value("ehm_events_total", {{"kind", "unreadable_peer"}, {"engine", "0"}}), 1.0);
  EXPECT_EQ(metrics.value("ehm_condition_active", {{"kind", "unreadable_peer"}}), 1.0);
  peer.reset();  // killed: known after its lease of 10 s
  EXPECT_TRUE(listener_.await([&] { return !said(false).empty(); }, seconds(40)));
  EXPECT_EQ(scrape().value("ehm_condition_active", {{"kind", "unreadable_peer"}}), 0.0);
}

TEST_F(UnreadableTest, AnAppendableTypeIsNamed) {
  const auto monitor = start_watched_monitor();
  const auto peer = start_peer("_appendable");
  EXPECT_THAT(only_message(),
              AllOf(writer_of_somebody, HasSubstr("an @appendable or @mutable type? needed is @final")));
}

TEST_F(UnreadableTest, AnotherNameOfTheTypeIsNamed) {
  const auto monitor = start_watched_monitor();
  idl::ParticipantOptions named = options(domain_);
  named.name = "the odd one";
  idl::Participant odd(named);
  eprosima::fastdds::dds::TypeSupport type(new EngineSensorsPubSubType());
  type->setName("rig::EngineSensors");
  auto* writer = odd.publisher()->create_datawriter(odd.topic("EngineSensors", type),
                                                    idl::writer_qos(idl::Delivery::stream, false, {}));
  ASSERT_NE(writer, nullptr);
  EXPECT_THAT(only_message(),
              AllOf(HasSubstr("topic EngineSensors: the writer of participant 'the odd one' at "),
                    HasSubstr("its type is named 'rig::EngineSensors', needed is 'ehm::EngineSensors'")));
  odd.publisher()->delete_datawriter(writer);
  EXPECT_TRUE(listener_.await([&] { return said(false).size() == 1; }));
}

TEST_F(UnreadableTest, ArraysOfAnotherLengthAreNamedBesideASourceThatIsRead) {
  const auto monitor = start_watched_monitor();
  const auto simulator = start_simulator();
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > 50; }));
  auto shorter = start_peer("_nine");  // 256 - 7 * 8 bytes, and 4 of the encapsulation
  EXPECT_THAT(only_message(),
              AllOf(writer_of_somebody, HasSubstr("its messages have 204 bytes, those of the type 260")));
  shorter.reset();  // the length that is named is that of the last message, whosever it was
  const auto longer = start_peer("_twenty");
  ASSERT_TRUE(listener_.await([&] { return said(true).size() == 2; }));
  EXPECT_THAT(said(true).back(), AllOf(writer_of_somebody, HasSubstr("its messages have 292 bytes")));
  // Each once, however many more messages come; and none for the simulator, whose estimates go on.
  const std::size_t estimates = listener_.health.size();
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > estimates + 200; }));
  EXPECT_EQ(said(true).size(), 2u);
  EXPECT_THAT(monitor->log(), testing::Not(HasSubstr("larger than the history")));
}

TEST_F(UnreadableTest, AReaderThatCanNeverReadUsIsNamed) {
  const auto monitor = start_watched_monitor();
  const auto peer = start_peer("_appendable", "listen");
  EXPECT_TRUE(listener_.await([&] { return said(true).size() >= 7; }));  // of the topics that the monitor writes
  EXPECT_EQ(said(true).size(), 7u);
  EXPECT_THAT(said(true),
              testing::Contains(AllOf(HasSubstr("topic EngineHealth: the reader of participant '' at UDPv4:["),
                                      HasSubstr(" can never read: it reads XCDR2, needed is XCDR1"))));
}

TEST_F(UnreadableTest, ReadablePeersAreNotNamed) {
  const auto monitor = start_watched_monitor();
  const auto simulator = start_simulator();
  const auto reader = start_peer("", "listen");
  const auto feeder = start_peer("");  // of engine 7, with too few sensors: of no use, but of the type
  ASSERT_TRUE(listener_.await([&] {
    return listener_.health.size() > 300 &&
           std::any_of(listener_.status.begin(), listener_.status.end(),
                       [](const MonitorStatus& s) { return s.unknown_engine_samples() > 100; });
  }));
  EXPECT_TRUE(said(true).empty()) << said(true).front();
  EXPECT_EQ(scrape().value("ehm_events_total", {{"kind", "unreadable_peer"}, {"engine", "1"}}), 0.0);
}

TEST_F(UnreadableTest, ListenNamesThem) {
  const auto xcdr2 = start_peer("", "feed-xcdr2");
  const auto shorter = start_peer("_nine");
  const auto listen = start_monitor({"--listen", "--seconds", "1"});
  EXPECT_EQ(listen->wait(seconds(20)), 1);
  EXPECT_THAT(listen->log(),
              AllOf(HasSubstr("ERROR: topic EngineSensors: the writer of participant '' at UDPv4:["),
                    HasSubstr("it writes XCDR2"), HasSubstr("its messages have 204 bytes"),
                    HasSubstr("verdict: NOT OK"), testing::Not(HasSubstr("no writer of EngineSensors"))));
}

}  // namespace
