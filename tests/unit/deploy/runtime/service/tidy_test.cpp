// SPDX-License-Identifier: Apache-2.0
// What strangers put into their samples: counts beyond the arrays, texts that steer terminals.

#include "idl/dds/tidy.h"

#include <fastcdr/Cdr.h>
#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "idl/dds/guarded_type.h"

namespace ehm::idl {
namespace {

TEST(Printable, KeepsTextAndReplacesWhatSteersOrIsNone) {
  EXPECT_EQ(printable("T48 \xc2\xb0"
                      "C \xe2\x82\xac \xf0\x9f\x98\x80"),
            "T48 \xc2\xb0"
            "C \xe2\x82\xac \xf0\x9f\x98\x80");
  EXPECT_EQ(printable("\x1b[2J\nx\x7f\t"), "?[2J?x??");
  EXPECT_EQ(printable("\xc2\x9b"), "??");                           // C1: CSI in one character
  EXPECT_EQ(printable("\xe2\x80\xae"), "???");                      // right to left from here
  EXPECT_EQ(printable("\xff\xfe \xc3 \xe2\x82"), "?? ? ??");        // no UTF-8, cut off
  EXPECT_EQ(printable("\xc0\xaf\xe0\x80\xaf"), "?????");            // overlong
  EXPECT_EQ(printable("\xed\xa0\x80\xf4\x90\x80\x80"), "???????");  // surrogate, beyond Unicode
}

TEST(Printable, GivesValidTextForAnyBytes) {
  std::mt19937 random(3);
  for (int k = 0; k < 20'000; ++k) {
    std::string bytes(random() % 12, '\0');
    for (char& c : bytes) c = static_cast<char>(random());
    const std::string text = printable(bytes);
    ASSERT_EQ(text.size(), bytes.size());
    for (std::size_t i = 0; i < text.size(); i += printable_length(text, i)) ASSERT_GT(printable_length(text, i), 0u);
    ASSERT_EQ(printable(text), text);
  }
}

/// As a reader of ours gets it from a writer that sends whatever it likes.
template <class PubSubType>
typename PubSubType::type received(typename PubSubType::type sent) {
  PubSubType plain;
  eprosima::fastrtps::rtps::SerializedPayload_t payload(plain.m_typeSize);
  EXPECT_TRUE(plain.serialize(&sent, &payload));
  GuardedType<PubSubType> guarded;
  typename PubSubType::type got;
  EXPECT_TRUE(guarded.deserialize(&payload, &got));
  return got;
}

TEST(Tidy, CountsNeverLeaveTheirArrays) {
  EngineHealth health;
  health.health_count(0xffffffffu);
  health.tuner_count(17);
  EXPECT_EQ(received<EngineHealthPubSubType>(health).health_count(), 0u);
  EXPECT_EQ(received<EngineHealthPubSubType>(health).tuner_count(), 0u);
  health.health_count(16);
  EXPECT_EQ(received<EngineHealthPubSubType>(health).health_count(), 16u);
  EngineSensors sensors;
  sensors.sensor_count(17);
  sensors.actuator_count(9);
  EXPECT_EQ(received<EngineSensorsPubSubType>(sensors).sensor_count(), 0u);
  EXPECT_EQ(received<EngineSensorsPubSubType>(sensors).actuator_count(), 0u);
  EngineAuxiliary auxiliary;
  auxiliary.auxiliary_count(9);
  EXPECT_EQ(received<EngineAuxiliaryPubSubType>(auxiliary).auxiliary_count(), 0u);
  EngineResiduals residuals;
  residuals.sensor_count(1u << 31);
  EXPECT_EQ(received<EngineResidualsPubSubType>(residuals).sensor_count(), 0u);
  EngineTruth truth;
  truth.health_count(99);
  truth.auxiliary_count(99);
  EXPECT_EQ(received<EngineTruthPubSubType>(truth).health_count(), 0u);
  EXPECT_EQ(received<EngineTruthPubSubType>(truth).auxiliary_count(), 0u);
}

TEST(Tidy, TextsAreCleaned) {
  auto description = std::make_unique<EngineDescription>();
  description->engine_type() = "\x1b]0;owned\a";
  description->sensors()[3].name() = "T30\nengine 7: all is well";
  description->sensors()[3].unit() =
      "\xc2\xb0"
      "C";
  description->sensor_count(17);
  const EngineDescription got = received<EngineDescriptionPubSubType>(*description);
  EXPECT_STREQ(got.engine_type().c_str(), "?]0;owned?");
  EXPECT_STREQ(got.sensors()[3].name().c_str(), "T30?engine 7: all is well");
  EXPECT_STREQ(got.sensors()[3].unit().c_str(),
               "\xc2\xb0"
               "C");
  EXPECT_EQ(got.sensor_count(), 0u);
  HealthEvent event;
  event.message() = "\xff\x1b[31m";
  EXPECT_STREQ(received<HealthEventPubSubType>(event).message().c_str(), "??[31m");
}

}  // namespace
}  // namespace ehm::idl
