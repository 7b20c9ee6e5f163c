// SPDX-License-Identifier: Apache-2.0
// `engine_sim maps`: its files, that their numbers are the map's, and what it refuses.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>

#include "deploy/runtime/files/csv_table.h"
#include "deploy/runtime/files/file_error.h"
#include "engine_sim/engines/jt9d.h"
#include "engine_sim/figures/contour_labels.h"
#include "engine_sim/figures/engine_figures.h"
#include "engine_sim/figures/operating_line.h"
#include "engine_sim/figures/reference_points.h"
#include "engine_sim/model/units.h"
#include "run_engine_sim.h"
#include "tests/temporary_folder.h"

namespace ehm::engine_sim {
namespace {

using testing::HasSubstr;

const char* const figure_names[] = {"fan", "lpc", "hpc", "hpt", "lpt"};

bool gnuplot_installed() {
  return std::system("command -v gnuplot >/dev/null 2>&1") == 0;
}

/// Every tag that opens also closes, in order: what an XML reader asks first.
bool well_formed(const std::string& xml) {
  std::vector<std::string> open;
  for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1)) {
    const std::size_t end = xml.find('>', at);
    if (end == std::string::npos) return false;
    const std::string tag = xml.substr(at + 1, end - at - 1);
    if (tag[0] == '?' || tag[0] == '!' || tag.back() == '/') continue;
    const std::string name = tag.substr(tag[0] == '/', tag.find_first_of(" \t\n/", 1) - (tag[0] == '/'));
    if (tag[0] != '/') {
      open.push_back(name);
      continue;
    }
    if (open.empty() || open.back() != tag.substr(1)) return false;
    open.pop_back();
  }
  return open.empty();
}

struct CsvFigure {
  explicit CsvFigure(const std::string& path) : table(files::read_csv(path)) {}
  double number(const files::CsvRow& row, const std::string& column) const {
    return files::parse_number(row.cells.at(table.column(column).value())).value();
  }
  files::CsvTable table;
};

class MapsTest : public testing::Test {
 protected:
  test::TemporaryFolder folder_;
};

TEST_F(MapsTest, WritesAPictureAndItsNumbersForEachComponent) {
  if (!gnuplot_installed()) GTEST_SKIP() << "gnuplot is not installed";
  const test::Result result = test::run_engine_sim({"maps", "--out", folder_.path("new/maps")});
  ASSERT_EQ(result.code, 0) << result.err;
  for (const std::string name : figure_names) {
    const std::string svg = folder_.content("new/maps/" + name + ".svg");
    EXPECT_TRUE(well_formed(svg)) << name;
    for (const char* text :
         {"<svg", "operating line, sea level static", "operating line, 10668 m Mach 0.8", "efficiency"})
      EXPECT_THAT(svg, HasSubstr(text)) << name;
    EXPECT_EQ(svg.find("reference points"), std::string::npos) << name;
    EXPECT_GT(CsvFigure(folder_.path("new/maps/" + name + ".csv")).table.rows.size(), 1000u);
  }
  for (const char* text : {"surge line", "corrected flow", "100 %", "90 %"})
    EXPECT_THAT(folder_.content("new/maps/fan.svg"), HasSubstr(text));
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path("new/maps"))) count += entry.exists();
  EXPECT_EQ(count, 10u);
}

TEST_F(MapsTest, TheNumbersAreTheMaps) {
  const std::map<std::string, const CompressorData*> compressors{
      {"fan", &jt9d().fan}, {"lpc", &jt9d().lpc}, {"hpc", &jt9d().hpc}};
  for (const Figure& figure : engine_figures(jt9d(), std::nullopt)) {
    const CsvFigure csv(folder_.file(figure.name + ".csv", figure_csv(figure)));
    int speed_lines = 0, surge = 0;
    for (const files::CsvRow& row : csv.table.rows) {
      const auto number = [&](const char* column) { return csv.number(row, column); };
      const std::string& kind = row.cells[0];
      if (!compressors.contains(figure.name)) {
        const TurbineData& t = figure.name == "hpt" ? jt9d().hpt : jt9d().lpt;
        const double map_pressure_ratio = 1.0 + (number("expansion_ratio") - 1.0) / t.scale.s_pr;
        const auto at = t.map.at(number("speed_percent"), map_pressure_ratio);
        // 1 lbm/s sqrt(R)/psia = 0.04903549 kg/s sqrt(K)/kPa (units.h)
        EXPECT_NEAR(number("flow_parameter_kg_s_sqrtk_per_kpa") / (t.scale.s_wc * at.flow * 0.04903549), 1.0, 1e-5);
        EXPECT_NEAR(number("efficiency"), t.scale.s_eff * at.efficiency, 1e-9);
        speed_lines += kind == "speed_line";
        continue;
      }
      const CompressorData& c = *compressors.at(figure.name);
      const double map_flow = number("corrected_flow_kg_s") / kg_per_lbm / c.scale.s_wc;
      const double map_pressure_ratio = 1.0 + (number("pressure_ratio") - 1.0) / c.scale.s_pr;
      if (kind == "surge_line") {
        ++surge;
        EXPECT_NEAR(map_pressure_ratio, c.map.surge_pressure_ratio(map_flow), 1e-9 * map_pressure_ratio);
        continue;
      }
      speed_lines += kind == "speed_line";
      const auto at = c.map.at(number("corrected_speed_percent") / 100.0, number("r_line"));
      EXPECT_NEAR(map_flow, at.flow, 1e-9 * at.flow);
      EXPECT_NEAR(map_pressure_ratio, at.pressure_ratio, 1e-9 * at.pressure_ratio);
      EXPECT_NEAR(number("efficiency"), c.scale.s_eff * at.efficiency, 1e-9);
    }
    EXPECT_GE(speed_lines, 5 * 81) << figure.name;
    EXPECT_EQ(surge, compressors.contains(figure.name) ? 101 : 0) << figure.name;
  }
}

// What the map says at the operating line is what the engine does there: pressure ratio across each component.
TEST_F(MapsTest, TheOperatingLineIsTheEngines) {
  const auto lines = operating_lines(Turbofan(jt9d()));
  ASSERT_EQ(lines.size(), 2u);
  // from the rating's maximum to its idle: at sea level on the design point's day T40 limits, and the ground's idle
  // holds
  const Ratings& ratings = jt9d().ratings;
  EXPECT_NEAR(lines[0].points.front().gas.s40.tt_k, ratings.t40_max_k, 1e-6);
  const GasPath& idle = lines[0].points.back().gas;
  EXPECT_NEAR(idle.speeds.n2_rpm / std::sqrt(idle.s2.tt_k / reference_temperature_k),
              ratings.ground_idle_corrected_n2_rpm, 1e-3);
  for (const Figure& figure : engine_figures(jt9d(), std::nullopt)) {
    const auto curves = curves_of(figure.curves, "operating_line");
    ASSERT_EQ(curves.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
      ASSERT_EQ(curves[i]->points.size(), lines[i].points.size());
      for (std::size_t k = 0; k < lines[i].points.size(); ++k) {
        const SteadyPoint& p = lines[i].points[k];
        const double loss = 1.0 - 0.0025;  // of the ducts before LPC and HPC (jt9d.cpp)
        const std::map<std::string, double> across{{"fan", p.gas.s21.pt_pa / p.gas.s2.pt_pa},
                                                   {"lpc", p.gas.s24.pt_pa / (p.gas.s21.pt_pa * loss)},
                                                   {"hpc", p.gas.s30.pt_pa / (p.gas.s24.pt_pa * loss)},
                                                   {"hpt", p.unknowns.pressure_ratio_hpt},
                                                   {"lpt", p.unknowns.pressure_ratio_lpt}};
        const bool compressor = figure.columns.size() == 5;
        EXPECT_NEAR(curves[i]->points[k][compressor ? 3 : 1] / across.at(figure.name), 1.0, 1e-6) << figure.name;
      }
    }
  }
}

TEST_F(MapsTest, ReferencePointsAreScaledAndUnconvergedOnesLeftOut) {
  std::string text = "conv,note";
  for (const char* component : {"Fan", "LPC", "HPC", "HPT", "LPT"}) {
    for (const char* quantity : {"_NcMap", "_WcMap", "_PRmap", "_effMap"})
      text += "," + (component + std::string(quantity));
  }
  const std::string numbers = ",0.9,1000,1.4,0.9,0.9,150,1.3,0.9,0.97,190,18,0.85,100,30,5,0.93,100,150,5,0.92\n";
  const std::string path = folder_.file("points.csv", text + "\n1,a" + numbers + "0,b" + numbers);
  for (const Figure& figure : engine_figures(jt9d(), files::read_csv(path))) {
    const auto curves = curves_of(figure.curves, "reference");
    ASSERT_EQ(curves.size(), 1u);
    EXPECT_EQ(curves[0]->points.size(), 1u);
    EXPECT_THAT(figure.script, HasSubstr("reference points"));
    if (figure.name != "fan") continue;
    EXPECT_NEAR(curves[0]->points[0][2], 1000.0 * jt9d().fan.scale.s_wc * kg_per_lbm, 1e-9);
    EXPECT_NEAR(curves[0]->points[0][3], 1.0 + 0.4 * jt9d().fan.scale.s_pr, 1e-9);
  }
}

TEST_F(MapsTest, RefusesAReferenceThatIsNone) {
  const auto run = [&](const std::string& reference) {
    return test::run_engine_sim({"maps", "--out", folder_.path("maps"), "--reference", reference});
  };
  EXPECT_THAT(run(folder_.path("nowhere.csv")).err, HasSubstr("nowhere.csv: no such file"));
  const test::Result no_column = run(folder_.file("a.csv", "Fan_NcMap\n1\n"));
  EXPECT_EQ(no_column.code, 2);
  EXPECT_THAT(no_column.err, HasSubstr("a.csv:1: column 'Fan_WcMap' is missing"));
  const test::Result no_number = run(folder_.file("b.csv", "Fan_NcMap,Fan_WcMap,Fan_PRmap,Fan_effMap\n1,x,1.5,0.9\n"));
  EXPECT_EQ(no_number.code, 2);
  EXPECT_THAT(no_number.err, HasSubstr("b.csv:2: 'Fan_WcMap' is 'x', allowed is a finite number"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path("maps")));
}

TEST_F(MapsTest, NamesAFolderThatCannotBeMade) {
  const test::Result result = test::run_engine_sim({"maps", "--out", folder_.file("file", "") + "/maps"});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("file/maps: is no folder and cannot be made: Not a directory"));
}

TEST_F(MapsTest, SaysThatGnuplotIsMissing) {
  const std::string before = std::getenv("PATH");
  setenv("PATH", folder_.path("empty").c_str(), 1);
  const test::Result result = test::run_engine_sim({"maps", "--out", folder_.path("maps")});
  setenv("PATH", before.c_str(), 1);
  EXPECT_EQ(result.code, 1);
  EXPECT_EQ(result.err, "engine_sim maps: gnuplot is not installed; install the package gnuplot-nox\n");
  EXPECT_FALSE(std::filesystem::exists(folder_.path("maps/fan.svg")));
}

TEST(ContourLabels, StandOnTheirContourAndApart) {
  // z = x on the unit square: the contour of level z is the vertical x = z
  std::vector<Curve> grid;
  for (int row = 0; row <= 20; ++row) {
    Curve line{"grid", "", {}};
    for (int i = 0; i <= 20; ++i) line.points.push_back({0.05 * i, 0.05 * row, 0.05 * i});
    grid.push_back(line);
  }
  const std::vector<double> levels{0.51, 0.49};
  const std::string text = contour_labels(curves_of(grid, "grid"), {0, 1, 2}, levels, {}, {0.0, 1.0}, {0.0, 1.0});
  double x[2], y[2];
  ASSERT_EQ(std::sscanf(text.c_str(), "set label '51 %%' at %lf,%lf", &x[0], &y[0]), 2) << text;
  const std::string second = text.substr(text.find('\n') + 1);
  ASSERT_EQ(std::sscanf(second.c_str(), "set label '49 %%' at %lf,%lf", &x[1], &y[1]), 2) << text;
  EXPECT_NEAR(x[0], 0.51, 1e-6);
  EXPECT_NEAR(x[1], 0.49, 1e-6);
  EXPECT_GT(std::abs(y[0] - y[1]), 0.4);
}

}  // namespace
}  // namespace ehm::engine_sim
