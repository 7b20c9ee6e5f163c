// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/recording/csv_rows.h"

#include <gmock/gmock.h>

#include <cmath>

#include "deploy/runtime/files/file_error.h"
#include "tests/temporary_folder.h"
#include "tests/unit/deploy/runtime/config/config_file.h"

namespace {

using namespace ehm;
using namespace ehm::recording;
using testing::AllOf;
using testing::HasSubstr;

/// unit, time, altitude in 1000 ft, Mach, fuel in lb/s, two temperatures in degree Rankine: as C-MAPSS files are.
ColumnMap example_map() {
  ColumnMap map;
  map.separator = files::Separator::blank;
  map.time_column = std::size_t{2};
  map.flight = {{"altitude_m", "m", false, 0, std::size_t{3}, 304.8, 0},
                {"mach", "", false, 0, std::size_t{4}, 1, 0},
                {"delta_isa_k", "K", true, 2.5, {}, 1, 0}};
  map.actuators = {{"fuel_flow", "kg/s", false, 0, std::size_t{5}, 0.45359237, 0}};
  map.sensors = {{"T24", "K", false, 0, std::size_t{6}, 1 / 1.8, 0},
                 {"T30", "K", false, 0, std::size_t{7}, 1 / 1.8, 0}};
  return map;
}

class CsvRowsTest : public testing::Test {
 protected:
  std::vector<Row> read(const std::string& text, const ColumnMap& map = example_map()) {
    CsvRows rows(folder_.file("x.txt", text), map);
    std::vector<Row> all;
    for (Row row; rows.next(row);) all.push_back(row);
    return all;
  }
  std::string error_of(const std::string& text, const ColumnMap& map = example_map()) {
    return test::message_of<files::FileError>([&] { read(text, map); });
  }
  test::TemporaryFolder folder_;
};

TEST_F(CsvRowsTest, BlankSeparatedRowsOfSeveralEngines) {
  const auto rows = read(
      "1 0.000 35 0.80 2.0 900 1400  \n"
      "2 5.000 35 0.80 2.0 910 1410\n"
      "\n"
      "1 0.015 35 0.81 2.0 nan 1401\n");
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].a.unit, 1);
  EXPECT_EQ(rows[1].a.unit, 2);
  EXPECT_EQ(rows[1].a.sequence, 0);
  EXPECT_EQ(rows[1].a.source_time_ns, 5'000'000'000);
  EXPECT_EQ(rows[2].a.sequence, 1);
  EXPECT_EQ(rows[2].a.source_time_ns, 15'000'000);
  EXPECT_EQ(rows[0].w[0], 35 * 304.8);
  EXPECT_EQ(rows[2].w[1], 0.81);
  EXPECT_EQ(rows[0].w[2], 2.5);
  EXPECT_EQ(rows[0].w[3], 2.0 * 0.45359237);
  EXPECT_DOUBLE_EQ(rows[0].x_s[1], 1400 / 1.8);
  EXPECT_EQ(rows[0].a.sensor_valid, 0b11);
  EXPECT_EQ(rows[2].a.sensor_valid, 0b10);  // the missing value
  EXPECT_TRUE(std::isnan(rows[2].x_s[0]));
  EXPECT_EQ(rows[0].a.sensor_count, 2);
  EXPECT_EQ(rows[0].a.actuator_count, 1);
}

TEST_F(CsvRowsTest, NamedColumnsOfACommaSeparatedFile) {
  ColumnMap map = example_map();
  map.separator = files::Separator::comma;
  map.header = true;
  map.engine_id_constant = true;
  map.engine_id = 9;
  map.equidistant = true;
  map.sample_time_s = 0.02;
  map.sensors[0].column = std::string("T24 [R]");
  const auto rows = read("a,b,alt,M,Wf,T24 [R],T30\n0,0,35,0.8,2,900,1400\n0,0,35,0.8,2,,1400\n", map);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1].a.unit, 9);
  EXPECT_EQ(rows[1].a.source_time_ns, 20'000'000);
  EXPECT_DOUBLE_EQ(rows[0].x_s[0], 900 / 1.8);
  EXPECT_EQ(rows[1].a.sensor_valid, 0b10);
  EXPECT_THAT(error_of("a,b,alt,M,Wf,T24,T30\n0,0,35,0.8,2,900,1400\n", map),
              HasSubstr("x.txt:1: the header has no column 'T24 [R]'"));
  EXPECT_THAT(error_of("a,b,alt,M,Wf,T24 [R],T30\n", map), HasSubstr("x.txt: has no row below its header"));
}

TEST_F(CsvRowsTest, TimesMayRepeatWhereTheMapSaysSo) {
  // A clock of 30 ms, samples every 10 ms, and one step back.
  const auto line = [](const char* time) { return std::string("1 ") + time + " 35 0.8 2 900 1400\n"; };
  const std::string text = line("5.00") + line("5.00") + line("5.00") + line("5.03") + line("5.02") + line("5.03") +
                           line("5.06") + line("5.06");
  EXPECT_THAT(error_of(text),
              HasSubstr("x.txt:2: column 2 is '5.00', allowed is a later time than in the row of engine "
                        "1 before; if it is a coarse clock's, the column map's [file] may say "
                        "time_may_repeat = true"));
  ColumnMap map = example_map();
  map.time_may_repeat = true;
  const auto rows = read(text, map);
  ASSERT_EQ(rows.size(), 8u);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].a.sequence, static_cast<std::int64_t>(i));
    EXPECT_EQ(rows[i].a.received_ns, 5'000'000'000 + static_cast<std::int64_t>(i) * 10'000'000) << i;
  }
  EXPECT_EQ(rows[1].a.source_time_ns, 5'000'000'000);
  EXPECT_EQ(rows[4].a.source_time_ns, 5'020'000'000);
  EXPECT_THAT(error_of(line("5") + line("2.9"), map),
              HasSubstr("x.txt:2: column 2 is '2.9', allowed is a time at most"));
  EXPECT_THAT(error_of(line("5") + line("5") + line("5"), map),
              HasSubstr("the time of engine 1 never rises; the column map's [file] needs sample_time_s"));
}

TEST_F(CsvRowsTest, MistakesAreNamedWithLineColumnAndValue) {
  const std::string good = "1 0 35 0.8 2 900 1400\n";
  EXPECT_THAT(error_of(good + "1 1 35 0.8 2 900\n"), HasSubstr("x.txt:2: 6 cells found, 7 expected"));
  EXPECT_THAT(error_of("1 0 35 0.8 2 900\n1 1 35 0.8 2 900\n"), HasSubstr("x.txt:1: 6 cells, the column map needs 7"));
  EXPECT_THAT(error_of("1,0,35,0.8,2,900,1400\n"), HasSubstr("needs 7; is the separator \"comma\"?"));
  EXPECT_THAT(error_of(good + "1 1 35 0.8x 2 900 1400\n"),
              HasSubstr("x.txt:2: column 4 is '0.8x', allowed is a number"));
  EXPECT_THAT(error_of(good + "1 1 nan 0.8 2 900 1400\n"),
              HasSubstr("x.txt:2: column 3 is 'nan', allowed is a number"));
  EXPECT_THAT(error_of(good + "1 1 35 0.8 2 hot 1400\n"), HasSubstr("column 6 is 'hot', allowed is a number, or nan"));
  EXPECT_THAT(error_of("0 0 35 0.8 2 900 1400\n"), HasSubstr("column 1 is '0', allowed is an engine id"));
  EXPECT_THAT(error_of("1.5 0 35 0.8 2 900 1400\n"), HasSubstr("column 1 is '1.5'"));
  EXPECT_THAT(error_of("1 1e10 35 0.8 2 900 1400\n"), HasSubstr("column 2 is '1e10', allowed is a time within 9e9 s"));
  EXPECT_THAT(error_of(good + good), HasSubstr("x.txt:2: column 2 is '0', allowed is a later time"));
  EXPECT_THAT(error_of(""), HasSubstr("x.txt: has no row"));
  EXPECT_THAT(test::message_of<files::FileError>([] { CsvRows("nowhere.txt", example_map()); }),
              HasSubstr("nowhere.txt: no such file"));
}

/// A map of `unit, alt, fuel, T` with the time counted, for rows in every writing.
ColumnMap written(files::Separator separator, std::optional<char> decimal, bool header) {
  ColumnMap map;
  map.separator = separator;
  map.header = header;
  map.decimal = decimal;
  map.equidistant = true;
  map.sample_time_s = 0.015;
  map.flight = {{"altitude_m", "m", false, 0, std::size_t{2}, 1, 0},
                {"mach", "", true, 0.8, {}, 1, 0},
                {"delta_isa_k", "K", true, 0, {}, 1, 0}};
  map.actuators = {{"fuel_flow", "kg/s", false, 0, std::size_t{3}, 1, 0}};
  map.sensors = {{"T24", "K", false, 0, std::size_t{4}, 1, 0}};
  return map;
}

TEST_F(CsvRowsTest, DecimalCommasAreReadWhereTheMapSaysSo) {
  using files::Separator;
  const auto rows = read("unit;alt;Wf;T\n1;10668,5;0,824;390,25\n", written(Separator::semicolon, ',', true));
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].w[0], 10668.5);
  EXPECT_EQ(rows[0].w[3], 0.824);
  EXPECT_EQ(rows[0].x_s[0], 390.25);
  EXPECT_EQ(read("1\t10668,5\t0,824\t390,25\n", written(Separator::tab, ',', false))[0].x_s[0], 390.25);
  EXPECT_EQ(read("1 10668,5 0,824 390,25\n", written(Separator::blank, ',', false))[0].x_s[0], 390.25);
  EXPECT_EQ(read("1,10668,\"0,824\",\"390,25\"\n", written(Separator::comma, ',', false))[0].x_s[0], 390.25);
}

TEST_F(CsvRowsTest, AnotherDecimalSignThanTheMapSaysIsNamed) {
  using files::Separator;
  EXPECT_THAT(
      error_of("1;10668,5;0,824;390,25\n", written(Separator::semicolon, {}, false)),
      HasSubstr("x.txt:1: column 2 is '10668,5', allowed is a number (altitude_m); the column map's [file] says "
                "decimal = \"comma\" for files written so"));
  EXPECT_THAT(error_of("1;10668.5;0.824;390.25\n", written(Separator::semicolon, ',', false)),
              HasSubstr("says decimal = \"point\" for files written so"));
  EXPECT_THAT(error_of("1;10,668;0;390\n", written(Separator::semicolon, {}, false)),
              HasSubstr("column 2 is '10,668', allowed is a number (altitude_m); is the comma one for thousands?"));
}

TEST_F(CsvRowsTest, RowsThatAreAllTornApartAreNotReadAsNumbers) {
  using files::Separator;
  // decimal commas between commas, without a header that would tell: 1; 10668.500; 0.024; 390.250
  EXPECT_THAT(
      error_of("1,10668,500,0,024,390,250\n1,10668,500,0,031,390,250\n",
               [] {
                 ColumnMap map = written(Separator::comma, {}, false);
                 map.sensors[0].column = std::size_t{5};
                 return map;
               }()),
      AllOf(HasSubstr("x.txt:1: column 5 is '024'"), HasSubstr("torn off the column before by a decimal comma")));
  // zeros in front are taken where the map says that there is nothing to doubt
  EXPECT_EQ(read("1,10668,1,0390\n", written(Separator::comma, '.', false))[0].x_s[0], 390.0);
}

TEST_F(CsvRowsTest, HeadersThatAreNoneOrAmbiguousAreNamed) {
  using files::Separator;
  EXPECT_THAT(
      error_of("1,10668,1,390\n1,10668,1,391\n", written(Separator::comma, {}, true)),
      HasSubstr("x.txt:1: the header holds numbers only; if the file has none, the column map needs header = false"));
  ColumnMap twice = written(Separator::comma, {}, true);
  twice.sensors[0].column = std::string("T");
  EXPECT_THAT(error_of("unit,alt,Wf,T,T\n1,10668,1,390,391\n", twice), HasSubstr("x.txt:1: column 'T' appears twice"));
}

}  // namespace
