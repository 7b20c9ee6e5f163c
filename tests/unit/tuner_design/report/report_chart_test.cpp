// SPDX-License-Identifier: Apache-2.0
// The pieces of a report, with plain data: text, tables, axes, charts.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "deploy/runtime/files/csv_table.h"
#include "tests/temporary_folder.h"
#include "tuner_design/report/page/axis.h"
#include "tuner_design/report/page/bar_chart.h"
#include "tuner_design/report/page/heat_map.h"
#include "tuner_design/report/page/html_table.h"
#include "tuner_design/report/page/line_chart.h"
#include "tuner_design/report/page/page.h"
#include "tuner_design/report/page/score_matrix.h"
#include "tuner_design/report/page/text.h"

namespace ehm::tuner_design::report {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

const double not_finite = std::nan("");

std::vector<std::string> attributes(const std::string& markup, const std::string& element, const std::string& name) {
  const std::regex pattern("<" + element + " [^>]*\\b" + name + "=\"([^\"]*)\"");
  std::vector<std::string> found;
  for (std::sregex_iterator it(markup.begin(), markup.end(), pattern), end; it != end; ++it) found.push_back((*it)[1]);
  return found;
}

TEST(ReportText, EscapesMarkupAndWhatXmlForbids) {
  EXPECT_EQ(escaped("<script>a && \"b\"</script>"), "&lt;script&gt;a &amp;&amp; &quot;b&quot;&lt;/script&gt;");
  // Control characters, DEL, a lone continuation byte and the non-characters U+FFFE, U+FFFF: XML 1.0, production 2
  for (const char* bad : {"\x01", "\x1b", "\x7f", "\x80", "\xEF\xBF\xBE", "\xEF\xBF\xBF"})
    EXPECT_EQ(escaped(bad), "\uFFFD");
  EXPECT_EQ(escaped("η 効率 é"), "η 効率 é");
}

TEST(ReportText, NumbersAreForPeople) {
  EXPECT_EQ(number(0.0), "0");
  EXPECT_EQ(number(16.141), "16.1");
  EXPECT_EQ(number(-0.26283), "−0.263");
  EXPECT_EQ(number(99.96), "100");
  EXPECT_EQ(number(0.0012345), "0.00123");
  EXPECT_EQ(number(2.7377e-5), "2.74 × 10⁻⁵");
  EXPECT_EQ(number(1.5e12, 2), "1.5 × 10¹²");
  EXPECT_EQ(number(not_finite), "–");
  EXPECT_EQ(listed({"a", "b", "c"}), "a, b and c");
  EXPECT_EQ(counted(1, "tuner"), "1 tuner");
}

TEST(ReportText, LongNamesGiveWay) {
  EXPECT_EQ(shortened("hpc_efficiency", 14), "hpc_efficiency");
  EXPECT_EQ(shortened("hpc_efficiency_stage_1", 11), "hpc_e…age_1");
  EXPECT_EQ(letters(shortened("効率効率効率効率", 7)), 7);  // three signs of two letters, and the dots
  EXPECT_THAT(broken("low pressure compressor efficiency", 14, 3),
              ElementsAre("low pressure ", "compressor ", "efficiency"));
  EXPECT_THAT(broken(std::string(25, 'x'), 10, 2), ElementsAre("xxxxxxxxxx", "xxxxx…xxxx"));
  EXPECT_THAT(broken("", 10, 2), ElementsAre(""));
}

TEST(ReportAxis, TicksAreRoundAndHoldTheData) {
  const Axis axis = Axis::linear({0.3, 1.83}, true, 5);
  std::vector<std::string> labels;
  for (const Tick& tick : axis.ticks()) labels.push_back(tick.label);
  EXPECT_THAT(labels, ElementsAre("0", "0.5", "1.0", "1.5", "2.0"));
  EXPECT_DOUBLE_EQ(axis.fraction(1.0), 0.5);

  const Axis decades = Axis::logarithmic({0.02, 300.0}, 8);  // 10^-2 to 10^3
  EXPECT_NEAR(decades.fraction(1.0), 0.4, 1e-12);
  EXPECT_FALSE(decades.shows(0.0));
  EXPECT_FALSE(decades.shows(-1.0));
}

TEST(ReportAxis, AnyValuesMakeAnAxis) {
  const std::vector<std::vector<double>> cases{{},           {0.0},           {5.0, 5.0}, {-2.0},
                                               {not_finite}, {1e-300, 1e300}, {-3.0, 1.0}};
  for (const auto& values : cases) {
    for (const Axis& axis :
         {Axis::linear(values, true, 5), Axis::linear(values, false, 5), Axis::logarithmic(values, 5)}) {
      EXPECT_GE(axis.ticks().size(), 2U);
      EXPECT_LE(axis.ticks().size(), 700U);
      for (const double value : values) {
        EXPECT_TRUE(axis.fraction(value) >= 0.0 && axis.fraction(value) <= 1.0) << value;
      }
    }
  }
}

BarChart two_bars(bool logarithmic) {
  BarChart chart{"bars", "Title", "Description", {"first", "second"}, {{"series", {1.0, 10.0}}}, {}, "axis, unit"};
  chart.logarithmic = logarithmic;
  return chart;
}

TEST(ReportBarChart, LengthsFollowTheValues) {
  const auto linear = attributes(draw(two_bars(false), wide_px, "bars"), "rect", "width");
  ASSERT_EQ(linear.size(), 2U);
  EXPECT_NEAR(std::stod(linear[1]), 10.0 * std::stod(linear[0]), 1.0);  // drawn to 0.1 px

  BarChart chart = two_bars(true);
  chart.categories.push_back("third");
  chart.series[0].values = {10.0, 100.0, 0.0};
  chart.marks.push_back({"mark", {1.0, 1.0, 1.0}});
  const std::string markup = draw(chart, wide_px, "bars");
  const auto widths = attributes(markup, "rect", "width");
  ASSERT_EQ(widths.size(), 2U);  // a logarithmic axis shows no zero
  EXPECT_NEAR(std::stod(widths[1]), 2.0 * std::stod(widths[0]), 0.2);
  EXPECT_THAT(markup, HasSubstr(">third</text>"));
}

TEST(ReportBarChart, NamesAreHarmlessInBothWidths) {
  BarChart chart = two_bars(false);
  chart.categories[0] = "<script>alert(1)</script>";
  for (const double width : {wide_px, narrow_px}) {
    const std::string markup = draw(chart, width, "bars");
    EXPECT_THAT(markup, Not(HasSubstr("<script")));
    EXPECT_THAT(markup, HasSubstr("&lt;script&gt;"));
  }
  EXPECT_NO_THROW(draw(BarChart{"empty", "", "", {}, {}, {}, ""}, wide_px, "empty"));
}

TEST(ReportLineChart, LeavesOutWhatAnAxisCannotShow) {
  LineChart chart{.id = "lines", .title = "Title", .description = "", .x = {"x"}, .y = {"y", true}, .series = {}};
  chart.series.push_back({"line", {0.0, 1.0, 2.0, 3.0, 4.0}, {1.0, 10.0, -1.0, 10.0, 100.0}});
  chart.series.push_back({"points", {0.0, 1.0}, {1.0, not_finite}, 2, Mark::circle});
  const std::string markup = draw(chart, narrow_px, "lines");
  EXPECT_EQ(attributes(markup, "polyline", "points").size(), 2U);  // interrupted at -1
  EXPECT_EQ(attributes(markup, "circle", "r").size(), 1U);
  EXPECT_THAT(markup, Not(HasSubstr("nan")));
  EXPECT_EQ(data_of(chart).rows.size(), 7U);
  EXPECT_NO_THROW(
      draw(LineChart{.id = "e", .title = "", .description = "", .x = {}, .y = {}, .series = {}}, 300.0, "e"));
}

TEST(ReportScoreMatrix, ColoursAreLogarithmicAboutOneAndDefectsAreMarked) {
  ScoreMatrix matrix{.id = "matrix",
                     .title = "Title",
                     .description = "Description",
                     .rows = {"first", "<b>"},
                     .columns = {"a", "b"},
                     .values = Eigen::MatrixXd(2, 2),
                     .marked = Eigen::MatrixXi::Zero(2, 2),
                     .scale_title = "scale",
                     .mark_title = "defect"};
  matrix.values << std::sqrt(0.1), 1000.0, 1.0, not_finite;
  matrix.marked(0, 1) = 1;
  const std::string markup = draw(matrix, wide_px, "matrix");
  const auto opacities = attributes(markup, "rect", "fill-opacity"), styles = attributes(markup, "rect", "class");
  EXPECT_EQ(std::vector(opacities.begin(), opacities.begin() + 4),
            (std::vector<std::string>{"0.50", "1.00", "0.00", "0.00"}));
  EXPECT_EQ(styles[0], "cell positive");
  EXPECT_EQ(styles[1], "cell negative");
  EXPECT_EQ(attributes(markup, "polygon", "points").size(), 2U);  // the cell, and the legend
  EXPECT_THAT(markup, Not(HasSubstr("<b>")));
  EXPECT_THAT(markup, Not(HasSubstr("nan")));

  matrix.bars = {1.0, not_finite};
  matrix.bar_title = "cost, s";
  for (const double width : {wide_px, narrow_px}) {
    const std::string barred = draw(matrix, width, "matrix");
    const auto fills = attributes(barred, "rect", "class");
    EXPECT_EQ(std::count(fills.begin(), fills.end(), "fill6"), 1);
    EXPECT_THAT(barred, HasSubstr("cost, s"));
  }
  EXPECT_NO_THROW(draw(ScoreMatrix{}, narrow_px, "empty"));
}

TEST(ReportHeatMap, StrengthAndSignFollowTheEntry) {
  HeatMap map{"map", "Title", "Description", {"row"}, {"a", "b", "c"}, Eigen::MatrixXd(1, 3), "unit", 2.0};
  map.values << 1.0, -2.0, 0.0;
  const std::string markup = draw(map, wide_px, "map");
  const auto opacities = attributes(markup, "rect", "fill-opacity");
  const auto styles = attributes(markup, "rect", "class");
  EXPECT_EQ(std::vector(opacities.begin(), opacities.begin() + 3), (std::vector<std::string>{"0.50", "1.00", "0.00"}));
  EXPECT_EQ(styles[0], "cell positive");
  EXPECT_EQ(styles[1], "cell negative");
  map.values.setConstant(not_finite);
  EXPECT_THAT(draw(map, narrow_px, "map"), Not(HasSubstr("\"nan\"")));
  EXPECT_NO_THROW(draw(HeatMap{"none", "", "", {}, {}, Eigen::MatrixXd(0, 0), ""}, wide_px, "none"));
}

TEST(ReportTable, DecimalsAreTheSameDownAColumn) {
  const DataTable table{{"name", "sigma [K]", "count"},
                        {{"a", 1.5903, 6.0}, {"b", 0.2537, 12.0}, {"c", 2.7e-5, 1.0}, {"d", no_number, 3.0}}};
  const std::string html = html_table(table, "Caption <1>", 1);
  for (const char* text :
       {">0.2537<", ">1.5903<", ">2.7 × 10⁻⁵<", ">–<", ">12<", "<caption>Caption &lt;1&gt;</caption>",
        "sigma<br/><span class=\"unit\">K</span>", "<tr class=\"total\"><th scope=\"row\">d</th>"}) {
    EXPECT_THAT(html, HasSubstr(text));
  }
}

TEST(ReportTable, CsvReadsBackExactly) {
  const test::TemporaryFolder folder;
  const DataTable table{{"name", "value [K]"}, {{"a, \"b\"\n<c>", 1.0 / 3.0}, {"=1+1", -2.7377e-05}, {"η", no_number}}};
  const files::CsvTable read = files::read_csv(folder.file("t.csv", to_csv(table)));
  EXPECT_THAT(read.header.cells, ElementsAre("name", "value [K]"));
  ASSERT_EQ(read.rows.size(), 3U);
  EXPECT_EQ(read.rows[0].cells[0], "a, \"b\" <c>");  // one record is one line
  EXPECT_EQ(std::stod(read.rows[0].cells[1]), 1.0 / 3.0);
  EXPECT_EQ(std::stod(read.rows[1].cells[1]), -2.7377e-05);
  EXPECT_EQ(read.rows[2].cells[1], "");
  EXPECT_EQ(to_json(table)["rows"][0][1], 1.0 / 3.0);
  EXPECT_EQ(to_json(table).dump().find("nan"), std::string::npos);
}

}  // namespace
}  // namespace ehm::tuner_design::report
