// SPDX-License-Identifier: Apache-2.0
// The studies as pages: each is one that any browser can show, what stands in it is the study's result, and published
// numbers are those that were printed.

#include "tuner_design/report/study_sections/study_sections.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/engines/shipped_engines.h"
#include "tests/temporary_folder.h"
#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/endurthi/health_study.h"
#include "tuner_design/endurthi/linearisation_study.h"
#include "tuner_design/endurthi/pendulum_study.h"
#include "tuner_design/endurthi/ukf_turbofan.h"
#include "tuner_design/family/family_study.h"
#include "tuner_design/kosanam/gain_search.h"
#include "tuner_design/kosanam/mapss_model.h"
#include "tuner_design/kosanam/robust_tables.h"
#include "tuner_design/lu/lu_study.h"
#include "tuner_design/report/study_sections/study_page.h"
#include "tuner_design/robust/robust_study.h"
#include "tuner_design/studies/simon_garg.h"

namespace ehm::tuner_design::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// As a browser, a screen reader and a firewall would see it.
void expect_sound(const Section& section) {
  const test::TemporaryFolder folder;
  const Page page = study_page(section, {"tuner_design study x <&>", "0.0", 1});
  const std::filesystem::path numbers = folder.path("numbers");
  std::filesystem::create_directory(numbers);
  for (const Section& part : page.sections)
    for (const auto& [id, table] : part.data) std::ofstream(numbers / (id + ".csv"), std::ios::binary) << to_csv(table);
  const std::string check = std::string("python3 ") + EHM_SOURCE_DIR +
                            "/tests/unit/tuner_design/report/check_page.py " + folder.file("page.html", to_html(page)) +
                            " " + numbers.string();
  EXPECT_EQ(std::system(check.c_str()), 0) << section.title;
}

const DataTable& table_in(const Section& section, const std::string& id) {
  for (const auto& [name, table] : section.data)
    if (name == id) return table;
  throw std::runtime_error("no table " + id);
}

double number_in(const Section& section, const std::string& id, const std::string& row, const std::string& column) {
  const DataTable& table = table_in(section, id);
  const auto at = std::find(table.columns.begin(), table.columns.end(), column) - table.columns.begin();
  for (const auto& cells : table.rows)
    if (std::get<std::string>(cells[0]) == row) return std::get<double>(cells.at(as_size(at)));
  throw std::runtime_error("no " + row + " in " + id);
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += what.size()) ++found;
  return found;
}

FamilyStudy made_up_family() {
  FamilyStudy study;
  study.options.engines = 2;
  study.design_name = "made up";
  study.estimators = {"good", "absent", "proud"};
  study.left_out = {"scheduled"};
  study.limit = 10.0;
  const FamilyScore good{.held = 1.0, .ssee = 5.0, .claims = 6.0, .coverage = 0.95, .bias = 0.1, .answer_s = 1.5};
  FamilyScore proud = good;
  proud.ssee = 200.0;
  proud.coverage = 0.5;
  proud.answer_s.reset();
  study.cases = {{FamilyCase::rapid, 2, 0, {good, std::nullopt, proud}}, {FamilyCase::slam, 1, 1, {good, {}, good}}};
  return study;
}

TEST(StudySections, TheFamilysMatrixShowsErrorHonestyAndCost) {
  FamilyStudy study = made_up_family();
  const Section section = family_section(study);
  expect_sound(section);
  EXPECT_DOUBLE_EQ(number_in(section, "family-figure", "good", "rapid fault [SSEE over the limit]"), 0.5);
  EXPECT_DOUBLE_EQ(number_in(section, "family-figure", "proud", "rapid fault [SSEE over the limit]"), 20.0);
  EXPECT_TRUE(std::isnan(number_in(section, "family-figure", "absent", "slam [SSEE over the limit]")));
  // one cell is marked, and the legend, in the wide and in the narrow drawing
  EXPECT_EQ(count(section.html, "class=\"defect\""), 4U);
  EXPECT_THAT(section.html, HasSubstr("1 engine of 2 did not fly to the end"));
  EXPECT_THAT(section.html, HasSubstr("Left out, since the design has not what they need: scheduled."));
  EXPECT_THAT(section.html, Not(HasSubstr("cost of a sample, µs")));  // no clock was read
  for (FamilyCaseResult& c : study.cases)
    for (auto& score : c.scores)
      if (score) score->step_us = 20.0;
  study.cases[1].scores[0]->step_us = 10.0;
  const Section timed = family_section(study);
  expect_sound(timed);
  EXPECT_THAT(timed.html, HasSubstr("cost of a sample, µs"));
  EXPECT_DOUBLE_EQ(number_in(timed, "family-figure", "good", "cost of a sample [us]"), 10.0);  // the least
}

TEST(StudySections, LusTablesAndFiguresStandBesideThePapers) {
  for (const int table : {4, 7, 8}) {
    LuOptions options{.engine = engine_sim::default_engine(), .table = table, .runs = 1, .particles = 2};
    const LuStudy study = run_lu_study(options);
    const Section section = lu_section(study);
    expect_sound(section);
    const std::string name = "lu-" + std::to_string(table);
    EXPECT_EQ(table_in(section, name + "-figure").rows.size(), study.cases.size());
    if (table == 4) {
      EXPECT_THAT(section.html, HasSubstr("The paper's figure 3: fault 1, Gaussian."));
      EXPECT_THAT(section.html, HasSubstr("The paper's figure 4: fault 2, Gaussian."));
      const DataTable& figures = table_in(section, "lu-4-figure");
      EXPECT_NEAR(std::get<double>(figures.rows[0].back()), 0.37, 0.005);  // EKF, fault 1: sum of table 4's means
      // estimates are those of the study, the truth steps at 1 s
      const DataTable& estimates = table_in(section, "lu-4-estimates-1");
      EXPECT_NEAR(std::get<double>(estimates.rows[10][2]), study.cases[0].first_estimates[30](0), 1e-4);
      EXPECT_EQ(std::get<double>(estimates.rows[16][11]), 0.0);   // 0.96 s
      EXPECT_EQ(std::get<double>(estimates.rows[17][11]), -9.0);  // 1.02 s
    }
    if (table == 7) {
      EXPECT_THAT(section.html, HasSubstr("not the same in every run"));
    }
    if (table == 8) {
      EXPECT_THAT(section.html, HasSubstr("The paper's figure 9: without P50."));
      EXPECT_THAT(section.html, HasSubstr("<td>diverged</td>"));  // published
    }
  }
}

TEST(StudySections, KosanamsTablesHaveThePublishedNumbers) {
  ConstrainedTablesOptions options;
  options.batch.runs = 1;
  options.batch.flights = 20;
  options.sweep = {1.0, 3.0};
  const ConstrainedTables tables = constrained_tables(mapss_model(), options);
  const Section section = constrained_section(tables);
  expect_sound(section);
  EXPECT_DOUBLE_EQ(number_in(section, "kosanam-5-1-table", "average", "published, Kalman [% of change]"), 4.6);
  EXPECT_DOUBLE_EQ(number_in(section, "kosanam-5-1-table", "average", "ours, W = I [% of change]"),
                   tables.table().of_change(constrained_case::identity));
  // figure 5.2 holds every flight of one engine
  const DataTable& estimates = table_in(section, "kosanam-5-1-plain");
  EXPECT_EQ(estimates.rows.size(), 20U * tables.health.size());
  EXPECT_NEAR(std::get<double>(estimates.rows[19][2]), tables.table().truth(0, 19), 1e-4);
  EXPECT_NEAR(std::abs(std::get<double>(estimates.rows[19][2])), tables.table().change(0), 1e-4);
}

TEST(StudySections, KosanamsRobustGainIsTheLowestOfItsCurve) {
  RobustTablesOptions options;
  options.batch.runs = 1;
  options.batch.flights = 10;
  const RobustTables tables = robust_tables(mapss_model(), options);
  const Section section = robust_tables_section(tables);
  expect_sound(section);
  EXPECT_DOUBLE_EQ(number_in(section, "kosanam-5-2-table", "average", "published, robust [% of change]"), 10.7);
  EXPECT_DOUBLE_EQ(number_in(section, "kosanam-5-3-table", "average", "published, standard [% of change]"), 4.9);
  // the curve begins at the standard gain and falls to the robust one
  const auto objective = [&](const RobustTrade& t) {
    return t.process + t.sensor + options.rho2 * t.sensor * t.sensor;
  };
  EXPECT_NEAR(objective(tables.trade.front()), tables.standard_objective, 1e-6 * tables.standard_objective);
  double least = tables.standard_objective;
  for (const RobustTrade& t : tables.trade) least = std::min(least, objective(t));
  EXPECT_GE(least, tables.robust_objective * (1.0 - 1e-9));
  EXPECT_LT(least, 1.05 * tables.robust_objective);
  // the surface is 1 where both elements are the standard ones
  const auto& share = tables.surface.share;
  const auto one = std::find_if(share.begin(), share.end(), [](double s) { return std::abs(s - 1.0) < 1e-9; });
  ASSERT_NE(one, share.end());
  EXPECT_NEAR(tables.surface.objective(one - share.begin(), one - share.begin()), 1.0, 1e-9);
}

TEST(StudySections, EndurthisModelsAndFilters) {
  const auto engine = engine_sim::default_engine();
  const endurthi::LinearisationStudy linear = endurthi::run_linearisation_study({engine, 2});
  const Section models = linearisation_section(linear);
  expect_sound(models);
  EXPECT_DOUBLE_EQ(number_in(models, "endurthi-3-table", "LIN222", "published, average [1e-4]"), 7.48);
  for (const endurthi::LinearisationPoint& point : linear.points) {
    ASSERT_EQ(point.trace.nonlinear.cols(), 121);  // 6 s each 0.05
    // what the tangent misses of the figure is what the table says, to its time step
    const double missed = (point.trace.tangent - point.trace.nonlinear).colwise().norm().mean() /
                          std::sqrt(static_cast<double>(point.trace.sensors.size())) / 0.5;
    EXPECT_NEAR(missed, point.errors[0][2][endurthi::tangent_model].average, 0.05 * missed);
  }
  endurthi::HealthStudyOptions options;
  options.engine = engine;
  options.runs = 1;
  options.flights = 3;
  options.life_flights = 8;
  options.relinearised_each = 4;
  options.threads = 2;
  const endurthi::HealthStudy health = endurthi::run_health_study(options);
  const Section filters = health_section(health);
  expect_sound(filters);
  EXPECT_EQ(table_in(filters, "endurthi-4-table").rows.size(), 2U * 28U + 27U);
  EXPECT_EQ(std::get<double>(table_in(filters, "endurthi-4-life-1").rows[1][2]), health.points[0].life[4].truth[0]);
  EXPECT_THAT(filters.html, HasSubstr("The thesis' figures 5.4a and 5.4b"));

  const auto pendulum = endurthi::run_pendulum_study({.runs = 2});
  expect_sound(pendulum_section(pendulum));
  endurthi::TurbofanPoint point{"idle", {"fan_flow"}, {}};
  point.filters = {{"ekf", {{0.1, 0.1}, {10.0, 10.0}}, 1.0, 0.9, 0}, {"ukf", {{0.2, 0.2}, {20.0, 20.0}}, 2.0, 0.9, 1}};
  expect_sound(turbofan_section({point}));
}

TEST(StudySections, GainsAndTheTablesOfSimonAndGarg) {
  const Section search = gain_search_section(search_gains({.test_runs = 2, .evaluations = 10}));
  expect_sound(search);
  EXPECT_THAT(search.html, HasSubstr("83"));
  const Section robust = robust_section(run_robust_study(test::made_up_model(), {}));
  expect_sound(robust);
  EXPECT_NEAR(number_in(robust, "robust-table", "published mean (Kosanam, tables 5.3 and 5.2)", "as modelled: ratio"),
              5.2 / 4.9, 1e-12);
  SimonGargOptions options;
  options.table = 4;
  options.engines = 200;
  const SimonGargStudy study = run_simon_garg(test::jt9d_cruise(), options);
  const Section tables = simon_garg_section(study);
  expect_sound(tables);
  EXPECT_EQ(table_in(tables, "simon-garg-figure").rows.size(), study.rows.size());
}

TEST(StudySections, ADrawingStandsAloneAsAPicture) {
  const test::TemporaryFolder folder;
  const std::string page = folder.file("page.html", to_html(study_page(family_section(made_up_family()), {"", "", 1})));
  const auto picture = [&](const std::string& drawing) {
    const std::string command = std::string("python3 ") + EHM_SOURCE_DIR + "/deploy/pictures/svg_of_page.py " + page +
                                " " + drawing + " > " + folder.path("out.svg") + " 2> " + folder.path("err");
    return std::system(command.c_str());
  };
  ASSERT_EQ(picture("family-matrix-wide"), 0) << folder.content("err");
  const std::string svg = folder.content("out.svg");
  EXPECT_THAT(svg, HasSubstr("<svg "));
  EXPECT_THAT(svg, HasSubstr("its sigma is too small"));
  EXPECT_THAT(svg, Not(HasSubstr("var(")));  // not every viewer knows them
  EXPECT_NE(picture("absent"), 0);
  EXPECT_THAT(folder.content("err"), HasSubstr("has no drawing absent"));
}

TEST(StudySections, APageSaysWhatMadeIt) {
  const Page page = study_page(family_section(made_up_family()), {"tuner_design study family --seed 7", "1.2", 7});
  const std::string html = to_html(page);
  EXPECT_THAT(html, HasSubstr("<td>tuner_design study family --seed 7</td>"));
  EXPECT_THAT(html, HasSubstr("<td>7</td>"));
  EXPECT_THAT(html, HasSubstr("tuner_design 1.2"));
  EXPECT_THAT(html, HasSubstr("<title>Every estimator in every case: Study</title>"));
}

}  // namespace
}  // namespace ehm::tuner_design::report
