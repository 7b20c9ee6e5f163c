// SPDX-License-Identifier: Apache-2.0
// The report of a design: what it says is what the design holds, and the page is one that any browser can show.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "deploy/runtime/numbers/index.h"
#include "monitor/design/design_file.h"
#include "monitor/design/make_filter.h"
#include "tests/temporary_folder.h"
#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/cli/commands.h"
#include "tuner_design/design/design_tuner.h"
#include "tuner_design/print/design_text.h"
#include "tuner_design/report/design_page.h"
#include "tuner_design/report/report_data.h"
#include "tuner_design/report/step_response.h"

namespace ehm::tuner_design::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

struct Result {
  int code;
  std::string out, err;
};

Result run(const std::vector<std::string>& arguments) {
  std::vector<const char*> argv{"tuner_design"};
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  std::ostringstream out, err;
  const int code = run_tuner_design(static_cast<int>(argv.size()), argv.data(), out, err);
  return {code, out.str(), err.str()};
}

/// Adds a linearisation error as a fleet fit would: some 0.1 % of each sensor and output.
linear_model::LinearModel with_linearisation_error(linear_model::LinearModel model) {
  Eigen::VectorXd sigma(model.C.rows() + model.F.rows());
  for (Eigen::Index i = 0; i < model.C.rows(); ++i) sigma(i) = 1e-3 * model.sensors[as_size(i)].trim;
  for (Eigen::Index i = 0; i < model.F.rows(); ++i) sigma(model.C.rows() + i) = 1e-3 * model.auxiliary[as_size(i)].trim;
  model.linearisation_error = sigma.cwiseAbs2().asDiagonal();
  return model;
}

linear_model::LinearModel without_auxiliary(linear_model::LinearModel model) {
  model.auxiliary.clear();
  model.F.resize(0, model.F.cols());
  model.G.resize(0, model.G.cols());
  model.N.resize(0, model.N.cols());
  return model;
}

linear_model::LinearModel oddly_named(linear_model::LinearModel model) {
  model.name = "</title><script>alert('model')</script> & \"co\" \x01";
  model.health[0].name = "<script>alert(1)</script>";
  model.health[1].name = std::string(63, 'W');
  model.health[2].name = "a,b;\"c\"\nd";
  model.sensors[2].name = "&amp;]]>";
  model.sensors[3].name = "圧縮機入口の温度";
  model.auxiliary[0].name = "<svg onload=alert(2)>";
  model.engine_type = "<b>";
  return model;
}

double number_in(const Page& page, const std::string& table_id, const std::string& row, const std::string& column) {
  for (const Section& section : page.sections) {
    for (const auto& [id, table] : section.data) {
      if (id != table_id) continue;
      const auto at = std::find(table.columns.begin(), table.columns.end(), column) - table.columns.begin();
      for (const auto& cells : table.rows) {
        if (std::get<std::string>(cells[0]) == row) return std::get<double>(cells.at(as_size(at)));
      }
    }
  }
  throw std::runtime_error("no " + row + ", " + column + " in " + table_id);
}

TEST(Report, PartsOfTheErrorAddUp) {
  for (const auto& model : {test::made_up_model(), with_linearisation_error(test::made_up_model())}) {
    const ReportData data = report_data(design_tuner(model, {}), {});
    for (const ErrorParts* parts : {&data.health, &data.auxiliary}) {
      const Eigen::VectorXd sum = parts->unseen + parts->noise + parts->linearisation;
      EXPECT_LT((sum - parts->total).cwiseAbs().maxCoeff(), 1e-9 * parts->total.maxCoeff());
      EXPECT_GT(parts->noise.minCoeff(), 0.0);
      // the limit holds for each channel by itself
      EXPECT_TRUE(((parts->unseen + parts->linearisation).array() >= parts->limit.array() * (1.0 - 1e-9)).all());
      EXPECT_EQ(parts->linearisation.sum() > 0.0, model.linearisation_error.size() > 0);
    }
  }
}

TEST(Report, StepResponseIsThatOfTheFilterThatFlies) {
  const linear_model::LinearModel model = test::made_up_model();
  const design::Design design = design_tuner(model, {});
  const ReportData data = report_data(design, {});
  const StepResponse response = step_response(design.full, data.model, 80);
  ASSERT_GT(response.time_s.size(), 40U);

  // the same experiment sample by sample in channel units, with the monitor's own filter
  constexpr Eigen::Index stepped = 2;
  Eigen::VectorXd h = Eigen::VectorXd::Zero(model.L.cols()), x = Eigen::VectorXd::Zero(model.A.rows());
  h(stepped) = model.health_sigma(stepped);
  estimation::TunerFilter filter = design::make_filter(design);
  const estimation::ActuatorVector idle = estimation::ActuatorVector::Zero(model.B.cols());
  estimation::SensorMask all;
  for (std::size_t i = 0; i < model.sensors.size(); ++i) all.set(i);
  std::size_t compared = 0;
  for (int k = 0; compared < response.time_s.size(); ++k) {
    filter.predict(idle);
    filter.innovation(model.C * x + model.M * h, idle);
    filter.update(all);
    x = (model.A * x + model.L * h).eval();
    if (std::abs(k * model.sample_time_s - response.time_s[compared]) > 1e-9) continue;
    const Eigen::VectorXd estimate = 100.0 * filter.health();  // fraction to percent
    EXPECT_LT((estimate - response.estimate[compared].col(stepped)).cwiseAbs().maxCoeff(), 1e-9) << k;
    ++compared;
  }
  // 5 time constants leave exp(-5) = 0.7 %, here of some 2 %
  EXPECT_LT((response.estimate.back() - data.settled).cwiseAbs().maxCoeff(), 0.05);
  EXPECT_GT((response.estimate.front() - data.settled).cwiseAbs().maxCoeff(), 0.05);
}

TEST(Report, NumbersAreThoseOfTheDesign) {
  const design::Design design = design_tuner(with_linearisation_error(test::made_up_model()), {});
  const Page page = design_page(design, {});
  const auto json = design_as_json(design);
  const std::string h = "SSEE(h) [percent²]", z = "SSEE(z) [mixed]";
  EXPECT_EQ(number_in(page, "totals", "This design", h), json["ssee_health"]["total"]);
  EXPECT_EQ(number_in(page, "totals", "This design", z), json["ssee_auxiliary"]["total"]);
  EXPECT_EQ(number_in(page, "totals", "Bayes limit", h), json["bayes_limit_health"]["total"]);
  EXPECT_EQ(number_in(page, "totals", "Full-order MAP", z), json["full_map_auxiliary"]["total"]);
  EXPECT_EQ(number_in(page, "totals", "MAP on the tuners", h), json["reduced_map_health"]["total"]);
  for (const auto& channel : design.model.health) {
    const double variance = json["ssee_health"]["by_channel"][channel.name].get<double>() +
                            json["linearisation_error_health"]["by_channel"][channel.name].get<double>();
    EXPECT_NEAR(number_in(page, "sigma-health", channel.name, "sigma total"), std::sqrt(variance), 1e-12);
  }
  EXPECT_DOUBLE_EQ(number_in(page, "missing-sensor", "y2", h),
                   json["without_sensor"]["y2"]["ssee_health"]["total"].get<double>());
  // the limit is not what the filter reaches: the two must not be mixed up
  EXPECT_NE(number_in(page, "totals", "Bayes limit", h), number_in(page, "totals", "This design", h));
}

TEST(Report, HtmlShowsNumbersOfItsTables) {
  const std::string html = to_html(design_page(design_tuner(test::made_up_model(), {}), {}));
  EXPECT_THAT(html, HasSubstr("<!DOCTYPE html>"));
  EXPECT_THAT(html, HasSubstr("times the Bayes limit"));
  EXPECT_EQ(html, to_html(design_page(design_tuner(test::made_up_model(), {}), {})));  // same input, same bytes
}

struct PageCase {
  std::string name;
  linear_model::LinearModel model;
  design::Tuning tuning = design::Tuning::kalman;
};

std::vector<PageCase> page_cases() {
  const auto two_sensors_one_health = test::made_up_model(2, 1);
  std::vector<PageCase> cases{{"plain", test::made_up_model()},
                              {"linearisation", with_linearisation_error(test::made_up_model())},
                              {"nothing_reduced", test::made_up_model(8, 4)},
                              {"no_auxiliary", without_auxiliary(test::made_up_model())},
                              {"one_health", two_sensors_one_health},
                              {"one_of_each", without_auxiliary(test::made_up_model(1, 1))},
                              {"full_wire", test::made_up_model(15, 16), design::Tuning::closed_form},
                              {"odd", oddly_named(test::made_up_model())},
                              {"jt9d", test::jt9d_cruise()}};
  if (const auto mapss = test::mapss()) cases.push_back({"mapss", *mapss});
  if (const auto mapss = test::mapss({0, 2, 4, 6, 8})) cases.push_back({"mapss_five", *mapss});
  return cases;
}

TEST(Report, EveryEngineMakesASoundPage) {
  const test::TemporaryFolder folder;
  for (const PageCase& page : page_cases()) {
    const std::string design = folder.path(page.name + ".json"), html = folder.path(page.name + ".html");
    design::DesignOptions options;
    options.tuning = page.tuning;
    design::write_design(design_tuner(page.model, options), design);
    const Result result = run({"report", design, "-o", html, "--csv-dir", folder.path(page.name), "--quick"});
    ASSERT_EQ(result.code, 0) << page.name << ": " << result.err;
    const std::string check = std::string("python3 ") + EHM_SOURCE_DIR +
                              "/tests/unit/tuner_design/report/check_page.py " + html + " " + folder.path(page.name);
    EXPECT_EQ(std::system(check.c_str()), 0) << page.name;
    EXPECT_THAT(folder.content(page.name + ".html"), Not(HasSubstr("<script")));
    EXPECT_THAT(folder.content(page.name + ".html"), Not(HasSubstr("onload=alert(2)>")));
  }
}

TEST(Report, StudiesStandBesideTheDesign) {
  const design::Design design = design_tuner(test::made_up_model(), {});
  const Studies studies = run_studies(design, {.quick = false, .threads = 2});
  const Page page = design_page(design, studies);
  // baselines: the design on one line, the full-order filter near it, the limit below both
  const std::string h = "SSEE(h) [percent²]";
  const double filter = number_in(page, "totals", "This design", h);
  EXPECT_LT(number_in(page, "totals", "Bayes limit", h), filter);
  EXPECT_GT(number_in(page, "totals", "Kalman filter on the best subset", h), filter);
  // the course of each start ends where the certificate says
  ASSERT_EQ(studies.courses.size(), design.certificate.starts.size());
  for (std::size_t i = 0; i < studies.courses.size(); ++i)
    EXPECT_DOUBLE_EQ(studies.courses[i].objective.back(), design.certificate.starts[i].last);
  // less speed, less noise
  ASSERT_GT(studies.trade.size(), 2U);
  EXPECT_GT(studies.trade.front().time_constant_s, studies.trade.back().time_constant_s);
  EXPECT_LT(studies.trade.front().health_noise, studies.trade.back().health_noise);
  // the made up engine has a linear truth only, and the page says so
  EXPECT_EQ(studies.experiments.size(), 3U);
  ASSERT_EQ(studies.not_flown.size(), 1U);
  const std::string html = to_html(page);
  EXPECT_THAT(html, HasSubstr("No experiment on the nonlinear engine"));
  EXPECT_THAT(html, HasSubstr("id=\"coverage\""));
  EXPECT_EQ(html, to_html(design_page(design, run_studies(design, {.quick = false, .threads = 1}))));
}

TEST(Report, QuickSaysWhatItLeavesOut) {
  const design::Design design = design_tuner(test::made_up_model(), {});
  const std::string html = to_html(design_page(design, run_studies(design, {.quick = true})));
  EXPECT_THAT(html, HasSubstr("The Monte Carlo was left out (--quick)"));
  EXPECT_THAT(html, Not(HasSubstr("id=\"coverage\"")));
}

TEST(Report, CheckOfPagesFindsDefects) {
  const test::TemporaryFolder folder;
  const Page page = design_page(design_tuner(test::made_up_model(), {}), {});
  const std::string good = to_html(page);
  const std::filesystem::path numbers = folder.path("numbers");
  std::filesystem::create_directory(numbers);
  for (const Section& section : page.sections) {
    for (const auto& [id, table] : section.data)
      std::ofstream(numbers / (id + ".csv"), std::ios::binary) << to_csv(table);
  }
  const auto sound = [&](const std::string& html) {
    const std::string check = std::string("python3 ") + EHM_SOURCE_DIR +
                              "/tests/unit/tuner_design/report/check_page.py " + folder.file("page.html", html) + " " +
                              numbers.string() + " > /dev/null";
    return std::system(check.c_str()) == 0;
  };
  const auto replaced = [&](const std::string& what, const std::string& with) {
    std::string html = good;
    return html.replace(html.find(what), what.size(), with);
  };
  EXPECT_TRUE(sound(good));
  EXPECT_FALSE(sound(replaced("</p>", "")));
  EXPECT_FALSE(sound(replaced("<main>", "<main><script>1</script>")));
  EXPECT_FALSE(sound(replaced("<main>", "<main><a href=\"https://example.com\">x</a>")));
  EXPECT_FALSE(sound(replaced("<caption>", "<caption></caption></table><table><tbody><tr><td>")));
  std::ofstream(numbers / "totals.csv", std::ios::app) << "\n";
  EXPECT_FALSE(sound(good));
}

TEST(Report, CommandSaysWhatIsWrong) {
  const test::TemporaryFolder folder;
  const std::string design = folder.path("design.json");
  design::write_design(design_tuner(test::made_up_model(), {}), design);
  EXPECT_EQ(run({"report", design}).code, 2);
  const Result absent = run({"report", folder.path("no.json"), "-o", folder.path("r.html")});
  EXPECT_EQ(absent.code, 2);
  EXPECT_THAT(absent.err, HasSubstr("no.json: no such file"));
  const Result itself = run({"report", design, "-o", design});
  EXPECT_EQ(itself.code, 2);
  EXPECT_THAT(itself.err, HasSubstr("--out is the design itself"));
  const Result no_folder = run({"report", design, "-o", folder.path("r.html"), "--csv-dir", design});
  EXPECT_EQ(no_folder.code, 2);
  EXPECT_THAT(no_folder.err, HasSubstr(design));
  EXPECT_EQ(run({"report", design, "-o", "/nonexistent/r.html"}).code, 2);

  const Result json = run({"report", design, "-o", folder.path("r.html"), "--json", "--quick"});
  ASSERT_EQ(json.code, 0) << json.err;
  EXPECT_EQ(nlohmann::json::parse(json.out)["design"]["hash"], design::read_design(design).hash);
  EXPECT_EQ(run({"report", design, "-o", folder.path("q.html"), "--quiet", "--quick"}).out, "");
}

}  // namespace
}  // namespace ehm::tuner_design::report
