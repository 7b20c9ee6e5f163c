// SPDX-License-Identifier: Apache-2.0
#include "monitor/dds/waiting_room.h"

#include <gmock/gmock.h>

namespace {

using ehm::monitor::Arrival;
using ehm::monitor::WaitingRoom;

Arrival arrival(std::uint32_t engine, std::uint64_t writer, std::uint64_t sequence) {
  Arrival a;
  a.sample.engine_id(engine);
  a.sample.sequence_number(sequence);
  a.writer = writer;
  return a;
}

std::vector<std::uint64_t> released(WaitingRoom& room, std::uint64_t waiting_writer) {
  std::vector<std::uint64_t> order;
  room.release([&](const Arrival& a) { return a.writer == waiting_writer; },
               [&](const Arrival& a) { order.push_back(a.sample.sequence_number()); });
  return order;
}

TEST(WaitingRoom, LetsGoInOrderWhoWaitsNoMore) {
  WaitingRoom room(8);
  for (std::uint64_t k = 0; k < 3; ++k) {
    room.add(arrival(1, 7, k));
    room.add(arrival(2, 9, 10 + k));
  }
  EXPECT_TRUE(room.holds(1, 7));
  EXPECT_FALSE(room.holds(1, 9));
  EXPECT_THAT(released(room, 9), testing::ElementsAre(0, 1, 2));
  EXPECT_FALSE(room.holds(1, 7));
  EXPECT_TRUE(room.holds(2, 9));
  room.add(arrival(2, 9, 13));
  EXPECT_THAT(released(room, 0), testing::ElementsAre(10, 11, 12, 13));
  EXPECT_TRUE(room.empty());
}

TEST(WaitingRoom, OfOneWriterAndEngineNoneOvertakesAnother) {
  WaitingRoom room(8);
  for (std::uint64_t k = 0; k < 3; ++k) room.add(arrival(1, 7, k));
  room.add(arrival(2, 7, 10));
  std::vector<std::uint64_t> order;
  room.release([](const Arrival& a) { return a.sample.sequence_number() == 0; },
               [&](const Arrival& a) { order.push_back(a.sample.sequence_number()); });
  EXPECT_THAT(order, testing::ElementsAre(10));
  EXPECT_THAT(released(room, 0), testing::ElementsAre(0, 1, 2));
}

TEST(WaitingRoom, SaysWhenItIsFull) {
  WaitingRoom room(2);
  room.add(arrival(1, 7, 0));
  EXPECT_FALSE(room.full());
  room.add(arrival(1, 7, 1));
  EXPECT_TRUE(room.full());
  EXPECT_THAT(released(room, 0), testing::ElementsAre(0, 1));
  EXPECT_FALSE(room.full());
}

}  // namespace
