// SPDX-License-Identifier: Apache-2.0
// Tables that are not whole, each of a kind: refused with the line, the cells expected and found, and what is the
// likely cause. And whole ones that look odd: taken.

#include "deploy/runtime/files/table_check.h"

#include <gmock/gmock.h>

#include "deploy/runtime/files/csv_table.h"
#include "deploy/runtime/files/file_error.h"
#include "tests/temporary_folder.h"
#include "tests/unit/deploy/runtime/config/config_file.h"

namespace {

using namespace ehm::files;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr TableFormat comma{}, comma_with_header{Separator::comma, true, false, true},
    semicolon{Separator::semicolon, true, true, true}, tab{Separator::tab, false, false, true},
    blank{Separator::blank, false, false, true}, blank_with_header{Separator::blank, true, false, true};

class TableCheckTest : public testing::Test {
 protected:
  std::vector<CsvRow> read(const std::string& text, const TableFormat& format) {
    return read_records(folder_.file("t", text), format);
  }
  /// The message behind the file's name; "accepted" where there is none.
  std::string error(const std::string& text, const TableFormat& format) {
    const std::string message = ehm::test::message_of<FileError>([&] { read(text, format); });
    return message.empty() ? "accepted" : message.substr(folder_.path("t").size());
  }
  ehm::test::TemporaryFolder folder_;
};

struct Torn {
  const char* name;
  TableFormat format;
  const char *text, *where, *cause;
};

class TornTable : public TableCheckTest, public testing::WithParamInterface<Torn> {};

TEST_P(TornTable, IsNamedWithItsLikelyCause) {
  EXPECT_THAT(error(GetParam().text, GetParam().format),
              AllOf(HasSubstr(GetParam().where), HasSubstr(std::string("Likely cause: ") + GetParam().cause)));
}

INSTANTIATE_TEST_SUITE_P(
    Each, TornTable,
    testing::Values(
        Torn{"missing_cell_between_blanks", blank, "1 0.0 5 7 \n1 0.1 5 7\n1 0.2   7\n1 0.3 7\n1 0.4 7\n1 0.5 7\n",
             ":3: 3 cells found, 4 expected, as many as the first row has", "a missing cell; where blanks separate"},
        Torn{"first_row_too_short", blank, "1 5\n1 5 7\n1 5 7\n1 5 7\n", ":2: 3 cells found, 2 expected",
             "the first line is not as the others are"},
        Torn{"blank_in_a_name", blank_with_header, "t T24 (K)\n0 390\n1 391\n", ":2: 2 cells found, 3 expected",
             "a name in the header has a blank in it"},
        Torn{"blank_for_thousands", blank, "1 147.5 0.5\n1 1 147.5 0.5\n", ":2: 4 cells found, 3 expected",
             "a blank for thousands"},
        Torn{"decimal_comma", comma_with_header, "t,M,T\n0,000,0,800,390,1\n0,015,0,800,391,2\n",
             ":2: 6 cells found, 3 expected, as many as the header has", "a decimal comma"},
        Torn{"comma_for_thousands", comma_with_header, "t,p,T\n0.1,752,747.5,390.1\n", ":2: 4 cells found, 3 expected",
             "a comma for thousands"},
        Torn{"comma_for_thousands_from_a_row_on", comma, "0.1,952.1,390.1\n0.2,1,147.5,390.1\n",
             ":2: 4 cells found, 3 expected, as many as the first row has", "a comma for thousands"},
        Torn{"thousands_or_decimals", comma_with_header, "t,p\n0,752\n1,752,747\n", ":3: 3 cells found, 2 expected",
             "a comma for thousands; write numbers without it, or a decimal comma"},
        Torn{"one_decimal_comma", comma_with_header, "k,M,T\n1,0,82,39\n2,0,824,39\n", ":2: 4 cells found, 3 expected",
             "a decimal comma"},
        Torn{"semicolons", comma_with_header, "t;M;T\n0;0,8;390,1\n", ":2: 3 cells found, 1 expected",
             "semicolons between the cells"},
        Torn{"index_without_a_name", comma_with_header, "a,b\n1,0.5,0.7\n2,0.5,0.7\n3,0.5,0.7\n",
             ":2: 3 cells found, 2 expected", "each row begins with a number that the header does not name"},
        Torn{"separator_at_the_end", comma_with_header, "a,b\n0.1,0.5,\n", ":2: 3 cells found, 2 expected",
             "a separator at the line's end"},
        Torn{"text_with_a_separator", comma_with_header, "name,unit\nspeed, fan,rpm\nT,K\n",
             ":2: 3 cells found, 2 expected", "a text with a separator in it; put it in quotes"},
        Torn{"missing_cell", comma_with_header, "a,b,c\n1,2,3\n1,2\n1,2,3\n", ":3: 2 cells found, 3 expected",
             "a missing cell; an empty one needs its separator"},
        Torn{"comment", comma_with_header, "a,b,c\n1,2,3\n# a break\n1,2,3\n", ":3: 1 cells found, 3 expected",
             "a comment"},
        Torn{"another_separator", comma_with_header, "a,b,c\n1;2;3\n", ":2: 1 cells found, 3 expected",
             "another separator, semicolon"},
        Torn{"cut_off_in_a_line", comma_with_header, "a,b,c\n1,2,3\n1,2", ":3: 2 cells found, 3 expected",
             "the file ends within this line: it was cut off"},
        Torn{"cut_off_in_a_line_of_blanks", blank, "1 2 3\n1 2 3\n1 2", ":3: 2 cells found, 3 expected",
             "the file ends within this line: it was cut off"},
        Torn{"cut_off_and_ended", comma_with_header, "a,b,c\n1,2,3\n1,2\n", ":3: 2 cells found, 3 expected",
             "a missing cell, or the file was cut off here"},
        Torn{"empty_tab_cell", tab, "1\t\t3\n1\t2\n", ":2: 2 cells found, 3 expected", "a missing cell"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST_F(TableCheckTest, TheMessageIsWhole) {
  EXPECT_EQ(
      error("a,b,c\n1,2,3\n1,2\n1,2,3\n", comma_with_header),
      ":3: 2 cells found, 3 expected, as many as the header has. Likely cause: a missing cell; an empty one needs "
      "its separator");
}

/// The last column of a file whose last line has no end, and whether that line is taken.
struct LastCells {
  const char* name;
  std::vector<std::string> above;
  const char* last;
  bool whole;
};

class LastLine : public TableCheckTest, public testing::WithParamInterface<LastCells> {};

TEST_P(LastLine, WithoutAnEndShowsWhetherItIsWhole) {
  std::string table;
  for (const std::string& cell : GetParam().above) table += "1,2," + cell + "\n";
  table += std::string("1,2,") + GetParam().last;
  const std::string line = ":" + std::to_string(GetParam().above.size() + 1) + ": ";
  if (GetParam().whole)
    EXPECT_EQ(error(table, comma), "accepted");
  else
    EXPECT_THAT(error(table, comma), AllOf(HasSubstr(line + "the last line has no newline"),
                                           HasSubstr("Likely cause: the file was cut off")));
  EXPECT_EQ(error(table + "\n", comma), "accepted");  // with an end there is nothing to doubt
}

INSTANTIATE_TEST_SUITE_P(
    Each, LastLine,
    testing::Values(LastCells{"fixed_decimals", {"1044.8309", "1043.4268"}, "1049.1068", true},
                    LastCells{"cut_in_the_decimals", {"1044.8309", "1043.4268"}, "1049.106", false},
                    LastCells{"cut_before_the_point", {"1044.8309", "1043.4268"}, "1049", false},
                    LastCells{"cut_at_the_point", {"1044.8309", "1043.4268"}, "1049.", false},
                    LastCells{"cut_to_one_digit", {"1044.8309", "1043.426"}, "1", false},
                    LastCells{"shortest_decimals", {"1044.8309", "1043.42"}, "1049.10", true},
                    LastCells{"point_among_whole_numbers", {"12", "7.25"}, "8.5", true},
                    LastCells{"whole_number_among_points", {"12.5", "7.25"}, "8", false},
                    LastCells{"whole_numbers", {"2388", "2387"}, "2390", true},
                    LastCells{"cut_whole_number", {"2388", "2387"}, "239", false},
                    LastCells{"exponents", {"1.5e+03", "1.4e+03"}, "1.3e+03", true},
                    LastCells{"cut_in_the_exponent", {"1.5e+03", "1.4e+03"}, "1.3e+0", false},
                    LastCells{"cut_before_the_exponent", {"1.5e+03", "1.4e+03"}, "1.3", false},
                    LastCells{"empty_among_numbers", {"1044.8", "1043.4"}, "", false},
                    LastCells{"empty_among_empty", {"", ""}, "", true},
                    LastCells{"missing_value", {"1044.8", "nan"}, "nan", true},
                    LastCells{"text", {"good", "bad"}, "goo", true}, LastCells{"first_line", {}, "1049", true}),
    [](const auto& test) { return std::string(test.param.name); });

TEST_F(TableCheckTest, ALastCellThatIsEndedByABlankOrAQuoteIsWhole) {
  EXPECT_EQ(error("1 2.25\n1 2.50\n1 2 ", blank), "accepted");
  EXPECT_EQ(error("1,\"2.25\"\n1,\"2.50\"\n1,\"2\"", comma), "accepted");
}

TEST_F(TableCheckTest, DecimalCommasCountAsDecimals) {
  EXPECT_THAT(error("a;b\n1;2,25\n1;2,50\n1;2", semicolon), HasSubstr("the file was cut off"));
  EXPECT_EQ(error("a;b\n1;2,25\n1;2,50\n1;2,75", semicolon), "accepted");
}

TEST_F(TableCheckTest, BlanksAndTabsInAnyNumberSeparate) {
  const auto rows = read("  1 2\t 3  \n\t1   2 3\r\n\n1 2 3   \n", blank);
  ASSERT_EQ(rows.size(), 3u);
  for (const CsvRow& row : rows) EXPECT_THAT(row.cells, ElementsAre("1", "2", "3"));
  EXPECT_EQ(rows[2].line, 4u);
}

TEST_F(TableCheckTest, SemicolonsAndTabsSeparateWithQuotesAndEmptyCells) {
  EXPECT_THAT(read("a;b\n0,5;\"x;y\"\n", semicolon)[1].cells, ElementsAre("0,5", "x;y"));
  EXPECT_THAT(read("1\t\t3\n", tab)[0].cells, ElementsAre("1", "", "3"));
}

TEST_F(TableCheckTest, LinesOfEverySystemAreRead) {
  for (const char* text : {"1,2\n3,4\n", "1,2\r\n3,4\r\n", "1,2\r3,4\r",
                           "\xEF\xBB\xBF"
                           "1,2\n3,4"}) {
    const auto rows = read(text, comma);
    ASSERT_EQ(rows.size(), 2u) << text;
    EXPECT_THAT(rows[0].cells, ElementsAre("1", "2"));
    EXPECT_EQ(rows[1].line, 2u);
    EXPECT_THAT(rows[1].cells, ElementsAre("3", "4"));
  }
}

TEST_F(TableCheckTest, WhatIsNoTextIsNamedAsWhatItIs) {
  using namespace std::string_literals;
  EXPECT_THAT(error("\xFF\xFE"
                    "1\0,\0002\0\n\0"s,
                    comma),
              AllOf(HasSubstr(": is UTF-16"), HasSubstr("iconv -f UTF-16")));
  EXPECT_THAT(error("\xFE\xFF\0001\0,\0002\0\n"s, comma), HasSubstr(": is UTF-16"));
  EXPECT_THAT(error("1\0,\0002\0\n\0"s, blank), HasSubstr(": looks like UTF-16 without its byte order mark"));
  EXPECT_THAT(error("\0001\0,\0002\0\n"s, comma), HasSubstr(": looks like UTF-16 without its byte order mark"));
  EXPECT_THAT(error("\xFF\xFE\0\0"
                    "1\0\0\0"s,
                    comma),
              HasSubstr(": is UTF-32"));
  EXPECT_THAT(error("1,2\n3,4\n"s + std::string(8, '\0'), comma), HasSubstr(":3: a NUL byte"));
}

TEST_F(TableCheckTest, QuotesThatTheFileEndsInAreNamed) {
  EXPECT_THAT(error("1,\"2\n", comma), AllOf(HasSubstr(":1: quotes do not match"), Not(HasSubstr("cut off"))));
  EXPECT_THAT(error("1,2\n3,\"4", comma),
              HasSubstr(":2: quotes do not match: '3,\"4'; the file ends within this line"));
}

TEST(TornOff, IsANumberWithALeadingZeroBehindAWholeOne) {
  const CsvRow row{1, {"0", "015", "10668", "000", "0.8", "05", "752", "089.3", "-1", "00", "x", "00"}};
  std::vector<std::size_t> torn;
  for (std::size_t i = 0; i < row.cells.size(); ++i)
    if (is_torn_off(row, i)) torn.push_back(i);
  EXPECT_THAT(torn, ElementsAre(1, 3, 7, 9));
}

TEST(Numbers, WithADecimalComma) {
  EXPECT_EQ(parse_number("0,5", ','), 0.5);
  EXPECT_EQ(parse_number("-1,5e3", ','), -1500.0);
  EXPECT_EQ(parse_number("7", ','), 7.0);
  for (const char* text : {"0.5", "1.234,5", "1,2,3", ",", ""})
    EXPECT_EQ(parse_number(text, ','), std::nullopt) << text;
}

}  // namespace
