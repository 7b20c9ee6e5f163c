// SPDX-License-Identifier: Apache-2.0
// The one error of the middleware that is kept from the log, and no other.

#include "idl/dds/middleware_log.h"

#include <gtest/gtest.h>

#include <fastdds/dds/log/Log.hpp>
#include <mutex>
#include <vector>

#include "idl/dds/endpoint.h"
#include "idl/wire_values.h"

namespace ehm::idl {
namespace {

/// All that the middleware says from now on; it has its own logging back at the end.
class Heard {
 public:
  Heard() {
    hear_middleware([this](const MiddlewareMessage& message) {
      const std::lock_guard lock(mutex_);
      messages_.push_back(message);
    });
  }
  ~Heard() { eprosima::fastdds::dds::Log::Reset(); }
  std::vector<MiddlewareMessage> messages() {
    eprosima::fastdds::dds::Log::Flush();
    const std::lock_guard lock(mutex_);
    return messages_;
  }

 private:
  std::mutex mutex_;
  std::vector<MiddlewareMessage> messages_;
};

TEST(MiddlewareLog, WhatAnOrderedStopSaysIsKnownToTheLetter) {
  ParticipantOptions options;
  options.domain = 228;
  options.name = "middleware log test";
  Participant participant(options);
  Writer<EngineHealth> writer(participant);
  EngineHealth estimate;
  estimate.engine_id(1);
  estimate.schema(schema_version);
  Heard heard;
  ASSERT_TRUE(writer.write(estimate));
  EXPECT_TRUE(heard.messages().empty());
  writer.release(estimate);
  const auto messages = heard.messages();
  ASSERT_FALSE(messages.empty()) << "the false alarm is gone: so can be its filter";
  for (const auto& message : messages)
    EXPECT_TRUE(is_of_no_concern(message)) << message.category << ": " << message.text;
}

TEST(MiddlewareLog, NothingElseIsKeptBack) {
  const MiddlewareMessage known{true, "DATA_WRITER", "Could not set the next deadline in the history"};
  EXPECT_TRUE(is_of_no_concern(known));
  for (const MiddlewareMessage& other : {
           MiddlewareMessage{true, "DATA_WRITER", "Could not get the next deadline from the history"},
           MiddlewareMessage{true, "DATA_READER", known.text},
           MiddlewareMessage{false, known.category, known.text},
           MiddlewareMessage{true, known.category, known.text + ", and the disk burns"},
           MiddlewareMessage{true, "RTPS_PARTICIPANT", "no port is free"},
           MiddlewareMessage{},
       })
    EXPECT_FALSE(is_of_no_concern(other)) << other.category << ": " << other.text;
}

}  // namespace
}  // namespace ehm::idl
