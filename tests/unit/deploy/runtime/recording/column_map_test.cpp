// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/recording/column_map.h"

#include <gmock/gmock.h>

#include "deploy/runtime/config/schema.h"
#include "tests/temporary_folder.h"
#include "tests/unit/deploy/runtime/config/config_file.h"

namespace {

using namespace ehm;
using namespace ehm::recording;
using testing::HasSubstr;

constexpr const char* file_part = R"([file]
separator = "blank"
header = false
engine_id_column = 1
sample_time_s = 0.015
)";
constexpr const char* channels_part = R"(
[[flight]]
name = "mach"
column = 4
[[flight]]
name = "altitude_m"
column = 3
factor = 304.8
[[flight]]
name = "delta_isa_k"
value = 1.5
[[actuator]]
name = "fuel_flow"
unit = "kg/s"
column = 5
factor = 0.45
[[sensor]]
name = "T24"
column = 6
factor = 0.5555555555555556
offset = -1.0
)";

class ColumnMapTest : public testing::Test {
 protected:
  ColumnMap read(const std::string& text) { return read_column_map(folder_.file("map.toml", text)); }
  std::string error_of(const std::string& text) {
    return test::message_of<config::ConfigError>([&] { read(text); });
  }
  test::TemporaryFolder folder_;
};

TEST_F(ColumnMapTest, TimesRiseUnlessItSaysTheyMayRepeat) {
  const std::string by_column = "[file]\nseparator = \"blank\"\nheader = false\nengine_id = 1\ntime_column = 2\n";
  EXPECT_FALSE(read(by_column + channels_part).time_may_repeat);
  EXPECT_TRUE(read(by_column + "time_may_repeat = true\n" + channels_part).time_may_repeat);
  EXPECT_THAT(error_of(by_column + "time_may_repeat = 1\n" + channels_part), HasSubstr("time_may_repeat"));
  EXPECT_THAT(error_of(std::string(file_part) + "time_may_repeat = true\n" + channels_part),
              HasSubstr("time_may_repeat"));  // sample_time_s leaves nothing to repeat
}

TEST_F(ColumnMapTest, IsReadInTheOrderOfTheWire) {
  const ColumnMap map = read(std::string(file_part) + channels_part);
  EXPECT_EQ(map.separator, files::Separator::blank);
  EXPECT_EQ(map.decimal, std::nullopt);
  EXPECT_FALSE(map.header);
  EXPECT_FALSE(map.engine_id_constant);
  EXPECT_TRUE(map.equidistant);
  ASSERT_EQ(map.flight.size(), 3u);
  EXPECT_EQ(map.flight[0].name, "altitude_m");
  EXPECT_EQ(map.flight[0].factor, 304.8);
  EXPECT_EQ(map.flight[1].name, "mach");
  EXPECT_TRUE(map.flight[2].constant);
  EXPECT_EQ(map.flight[2].value, 1.5);
  ASSERT_EQ(map.sensors.size(), 1u);
  EXPECT_EQ(std::get<std::size_t>(map.sensors[0].column), 6u);
  EXPECT_EQ(map.sensors[0].offset, -1.0);
}

TEST_F(ColumnMapTest, AModelWithoutControlsNeedsNoActuator) {
  std::string channels = channels_part;
  const auto from = channels.find("[[actuator]]"), to = channels.find("[[sensor]]");
  channels.erase(from, to - from);
  EXPECT_TRUE(read(file_part + channels).actuators.empty());
}

TEST_F(ColumnMapTest, MistakesAreNamedWithTheirLine) {
  const std::string file = file_part, channels = channels_part;
  EXPECT_THAT(error_of(channels), HasSubstr("table [file] is missing"));
  EXPECT_THAT(error_of(file), HasSubstr("'flight' is missing, allowed are 1 to 3 tables [[flight]]"));
  EXPECT_THAT(error_of("[file]\nseparator = \"bar\"\n"),
              HasSubstr("map.toml:2: 'file.separator' is 'bar', allowed is"));
  EXPECT_THAT(error_of("[file]\nseparator = \"comma\"\nheader = 1\n"), HasSubstr("map.toml:3: 'file.header'"));
  EXPECT_THAT(error_of("[file]\nseparator = \"comma\"\nheader = false\nengine_id_column = 0\n"),
              HasSubstr("map.toml:4: 'file.engine_id_column' is 0, allowed is a whole number from 1"));
  EXPECT_THAT(error_of("[file]\nseparator = \"comma\"\nheader = false\nengine_id_column = \"unit\"\n"),
              HasSubstr("map.toml:4: 'file.engine_id_column' is not a whole number"));  // names need a header
  EXPECT_THAT(error_of(file + "speed = 1\n" + channels), HasSubstr("map.toml:6: unknown key 'file.speed'"));
  EXPECT_THAT(error_of(file + channels + "[[sensors]]\nname = \"Nf\"\n"), HasSubstr("unknown key 'sensors'"));
  EXPECT_THAT(error_of(file + channels + "[[sensor]]\nname = \"T24\"\ncolumn = 9\n"),
              HasSubstr("'sensor.name' is 'T24' for the second time"));
  EXPECT_THAT(error_of(file + channels + "[[sensor]]\nname = \"Nf\"\n"), HasSubstr("'sensor.column' is missing"));
  std::string without_mach = file + channels;
  without_mach.replace(without_mach.find("mach"), 4, "alpha");
  EXPECT_THAT(error_of(without_mach), HasSubstr("[[flight]] 'mach' is missing"));
}

TEST_F(ColumnMapTest, SeparatorsAndDecimals) {
  const auto with = [](const std::string& separator, const std::string& more) {
    return "[file]\nseparator = \"" + separator + "\"\nheader = false\nengine_id = 1\nsample_time_s = 0.015\n" + more +
           channels_part;
  };
  EXPECT_EQ(read(with("semicolon", "decimal = \"comma\"\n")).decimal, ',');
  EXPECT_EQ(read(with("semicolon", "")).separator, files::Separator::semicolon);
  EXPECT_EQ(read(with("tab", "decimal = \"point\"\n")).separator, files::Separator::tab);
  EXPECT_EQ(read(with("comma", "decimal = \"point\"\n")).decimal, '.');
  EXPECT_THAT(error_of(with("comma", "decimal = \",\"\n")), HasSubstr("map.toml:6: 'file.decimal' is ',', allowed is"));
}

TEST_F(ColumnMapTest, FlightChannelsLeaveInTheUnitsOfTheirNames) {
  const auto flight = [](const std::string& altitude, const std::string& mach, const std::string& delta) {
    return "[[flight]]\nname = \"altitude_m\"\n" + altitude + "[[flight]]\nname = \"mach\"\n" + mach +
           "[[flight]]\nname = \"delta_isa_k\"\n" + delta +
           "[[actuator]]\nname = \"fuel_flow\"\nvalue = 1.0\n[[sensor]]\nname = \"T24\"\ncolumn = 6\n";
  };
  const std::string percent = "column = 4\nunit = \"percent\"\n", plain = "value = 0.8\n";
  // 35 of 1000 ft with 0.5 added, which is 35500 ft, 10820.4 m; 9 degF of difference are 5 K
  const ColumnMap map =
      read(file_part + flight("column = 3\nunit = \"kft\"\noffset = 0.5\n", percent, "value = 9.0\nunit = \"degF\"\n"));
  EXPECT_DOUBLE_EQ(map.flight[0].factor * 35.0 + map.flight[0].offset, 35500.0 * 0.3048);
  EXPECT_EQ(map.flight[0].unit, "m");
  EXPECT_DOUBLE_EQ(map.flight[1].factor * 80.0, 0.8);
  EXPECT_DOUBLE_EQ(map.flight[2].value, 5.0);
  EXPECT_THAT(
      error_of(file_part + flight("column = 3\nunit = \"hPa\"\n", plain, "value = 0.0\n")),
      HasSubstr("[[flight]] 'altitude_m' has the unit 'hPa', needed is 'm' or one that converts to it: 'hPa' is a "
                "pressure, 'm' is a length"));
}

}  // namespace
