// SPDX-License-Identifier: Apache-2.0
// Lines are added behind the others, whatever happened to the last; the folder tells which engines it knows.

#include "monitor/history/history_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "deploy/runtime/files/file_error.h"
#include "monitor/history/history_text.h"
#include "tests/temporary_folder.h"

namespace {

using namespace ehm;
using namespace ehm::monitor;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

Flight some_flight(std::uint32_t number) {
  Flight f;
  f.number = number;
  f.start_ns = 1'700'000'000'000'000'000;
  f.landing_ns = f.start_ns + 6'500'000'000'000;
  f.design_hash = std::string(64, 'd');
  f.samples = 480'000;
  f.estimated = 479'999;
  f.events = 2;
  f.phase_s[3] = 1100.25;
  f.health = {{"hpc_efficiency", "fraction", -0.021, 0.003, -0.002}};
  f.sensors = {{"T48", "K", 1310.5, 1310.5},
               {"P24", "kPa", -std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}};
  f.auxiliary = {{"T40", "K", 900.0, 1650.0}};
  f.margins = FlightMargins{41.5, 1.75, 0.032, 0.0014};
  return f;
}

class HistoryFolderTest : public testing::Test {
 protected:
  test::TemporaryFolder folder_;
};

TEST_F(HistoryFolderTest, AFlightIsReadAsItWasWritten) {
  add_to_history(folder_.path(), 7, to_line(some_flight(1)));
  add_to_history(folder_.path(), 7,
                 to_line(Maintenance{Maintenance::Kind::wash, 1'700'000'100'000'000'000, "hangar 2"}));
  const FlightHistory history = read_history(folder_.path(), 7);
  ASSERT_EQ(history.entries.size(), 2u);
  const Flight& f = history.entries[0].flight.value();
  EXPECT_EQ(to_line(f), to_line(some_flight(1)));
  EXPECT_EQ(f.samples, 480'000u);
  EXPECT_EQ(f.margins.value().egt_k, 41.5);
  EXPECT_EQ(f.sensors.size(), 1u) << "nothing was seen of P24";
  EXPECT_EQ(history.entries[1].maintenance.value().note, "hangar 2");
  EXPECT_TRUE(history.torn.empty());
}

TEST_F(HistoryFolderTest, ALineThatWasCutOffIsLeftOutAndTheNextOneStandsByItself) {
  const std::string line = to_line(some_flight(1));
  folder_.file("engine_7_flights.jsonl", line + line.substr(0, 100));
  FlightHistory history = read_history(folder_.path(), 7);
  EXPECT_EQ(history.entries.size(), 1u);
  EXPECT_THAT(history.torn, HasSubstr("engine_7_flights.jsonl:2"));
  add_to_history(folder_.path(), 7, to_line(some_flight(2)));
  // In the middle of a file nothing is guessed: the line is named.
  try {
    read_history(folder_.path(), 7);
    ADD_FAILURE() << "a line that is no object was taken";
  } catch (const files::FileError& error) {
    EXPECT_THAT(error.what(), HasSubstr("engine_7_flights.jsonl:2"));
  }
}

TEST_F(HistoryFolderTest, WhatCanBeReadOfADamagedListIsTakenAndTheRestIsNamed) {
  const std::string flight = to_line(some_flight(1)), later = to_line(some_flight(2));
  folder_.file("engine_7_flights.jsonl", flight + "no flight\n" + later);
  const FlightHistory between = read_what_can_be(folder_.path(), 7);
  EXPECT_EQ(between.entries.size(), 2u);
  ASSERT_EQ(between.damaged.size(), 1u);
  EXPECT_THAT(between.damaged[0], HasSubstr("engine_7_flights.jsonl:2"));
  EXPECT_FALSE(between.damaged_since_flight);
  // Behind the last flight it may have been a replacement.
  folder_.file("engine_8_flights.jsonl", flight + later + "no flight\n");
  EXPECT_TRUE(read_what_can_be(folder_.path(), 8).damaged_since_flight);
}

TEST_F(HistoryFolderTest, TellsWhichEnginesItKnows) {
  folder_.file("engine_12.json", "a checkpoint");
  folder_.file("engine_x_flights.jsonl", "");
  folder_.file("engine_31_flights.jsonl", "");
  folder_.file("engine_4_baseline.json", "");
  EXPECT_THAT(engines_in(folder_.path()), ElementsAre(4u, 31u));
  EXPECT_THROW(engines_in(folder_.path() + "/none"), files::FileError);
  EXPECT_TRUE(read_history(folder_.path(), 5).entries.empty());
  EXPECT_FALSE(read_baseline(folder_.path(), 5));
  EXPECT_THROW(read_baseline(folder_.path(), 4), files::FileError);
}

TEST_F(HistoryFolderTest, AWrongLineIsNamedWithItsKey) {
  folder_.file("engine_7_flights.jsonl", R"({"schema":"ehm-flight/1","kind":"overhaul","time_ns":1})"
                                         "\n");
  try {
    read_history(folder_.path(), 7);
    ADD_FAILURE() << "an unknown kind was taken";
  } catch (const files::FileError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("kind is overhaul"), HasSubstr("flight, wash or replacement")));
  }
}

TEST_F(HistoryFolderTest, IsShownWithWhatIsKnown) {
  const std::string text = flight_text(some_flight(3));
  EXPECT_THAT(text, HasSubstr("EGT margin 41.5 +- 1.8 K, thrust margin 3.2 +- 0.1 %"));
  EXPECT_THAT(text, HasSubstr("hpc_efficiency"));
  EXPECT_THAT(text, HasSubstr("-2.10"));
  EXPECT_THAT(text, Not(HasSubstr("since flights"))) << "nothing is known that wear could be counted from";
  Flight later = some_flight(9);
  later.flights_learned = 3;
  EXPECT_THAT(flight_text(later), testing::AllOf(HasSubstr("since flights 1 to 3"), HasSubstr("-0.20")));
  EXPECT_THAT(text, HasSubstr("climb 1100 s"));
  EXPECT_THAT(text, Not(HasSubstr("P24")));
  EXPECT_THAT(history_text(7, {}, 0.0), HasSubstr("engine 7: no flight has been noted"));
}

}  // namespace
