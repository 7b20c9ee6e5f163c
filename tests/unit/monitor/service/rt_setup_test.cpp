// SPDX-License-Identifier: Apache-2.0
#include "monitor/realtime/rt_setup.h"

#include <gmock/gmock.h>

#include <stdexcept>

#include "monitor/realtime/arrival_clock.h"

namespace {

using namespace ehm::monitor;
using testing::ElementsAre;

TEST(CpuList, NumbersAndRanges) {
  EXPECT_THAT(parse_cpu_list(""), ElementsAre());
  EXPECT_THAT(parse_cpu_list("3"), ElementsAre(3));
  EXPECT_THAT(parse_cpu_list("0,2-4,7"), ElementsAre(0, 2, 3, 4, 7));
}

TEST(CpuList, RefusesWhatIsNone) {
  for (const char* text : {",", "0,", "x", "1-", "-1", "2-1", "0 1", "1.5", "1024", "99999999999999999999"})
    EXPECT_THROW(parse_cpu_list(text), std::invalid_argument) << text;
}

constexpr std::int64_t ms = 1'000'000, wall_ahead = 1'700'000'000'000 * ms;

TEST(ArrivalClock, ConvertsReceptionsToTheMonotonicClock) {
  ArrivalClock clock;
  clock.wake_up(1000 * ms, wall_ahead + 1000 * ms);
  clock.wake_up(1015 * ms, wall_ahead + 1015 * ms);
  EXPECT_EQ(clock.monotonic_of(wall_ahead + 1014 * ms), 1014 * ms);
}

TEST(ArrivalClock, AStepOfTheWallClockIsNoLatency) {
  for (const std::int64_t step : {-3600'000 * ms, 3600'000 * ms}) {
    ArrivalClock clock;
    clock.wake_up(1000 * ms, wall_ahead + 1000 * ms);
    clock.wake_up(1015 * ms, wall_ahead + step + 1015 * ms);
    EXPECT_EQ(clock.monotonic_of(wall_ahead + 1014 * ms), 1015 * ms) << "received before the step";
    EXPECT_EQ(clock.monotonic_of(wall_ahead + step + 1014 * ms), 1015 * ms) << "received behind it";
    clock.wake_up(1030 * ms, wall_ahead + step + 1030 * ms);
    EXPECT_EQ(clock.monotonic_of(wall_ahead + step + 1029 * ms), 1029 * ms);
  }
}

TEST(ArrivalClock, APauseOfTheProcessIsALatency) {
  ArrivalClock clock;
  clock.wake_up(1000 * ms, wall_ahead + 1000 * ms);
  clock.wake_up(9000 * ms, wall_ahead + 9000 * ms);
  EXPECT_EQ(clock.monotonic_of(wall_ahead + 4000 * ms), 4000 * ms);
}

}  // namespace
