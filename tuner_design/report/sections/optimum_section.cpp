// SPDX-License-Identifier: Apache-2.0
// Whether the tuners are at an optimum: the certificate, and how the starts of the search came there.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tuner_design/report/page/line_chart.h"
#include "tuner_design/report/page/text.h"
#include "tuner_design/report/sections/sections.h"

namespace ehm::tuner_design::report {
namespace {

constexpr double least_shown = 1e-12;  ///< differences below are rounding

DataTable certificate_table(const design::Certificate& certificate) {
  DataTable table{{"item", "value"}, {}};
  const auto add = [&](const std::string& item, double value) { table.rows.push_back({item, value}); };
  add("Objective J of these tuners", certificate.objective);
  add("J of the closed form H Ph", certificate.closed_form_objective);
  add("J of the Bayes limits, which nothing can pass", certificate.lower_bound);
  add("Slope |dJ/dV|", certificate.gradient_norm);
  add("Gain that the slope promises (one Newton step)", certificate.possible_gain);
  add("Least curvature", certificate.least_curvature);
  add("Largest curvature", certificate.largest_curvature);
  add("Directions that J does not notice", static_cast<double>(certificate.flat_directions));
  add("Condition of the scaled sensitivity", certificate.condition);
  const Eigen::VectorXd& pair = certificate.pair_singular_values;
  if (pair.size() > 0) {
    add("Observability of state and tuners, strongest singular value", pair(0));
    add("Observability of state and tuners, weakest singular value", pair(pair.size() - 1));
  }
  return table;
}

DataTable starts_table(const design::Certificate& certificate) {
  DataTable table{
      {"start", "J there", "J reached", "above J of the design", "|dJ/dV|", "angle to V* [deg]", "evaluations"}, {}};
  for (const design::SearchStart& start : certificate.starts) {
    table.rows.push_back({start.name, start.first, start.last, start.last / certificate.objective - 1.0,
                          start.gradient_norm, start.angle_rad * 180.0 / std::numbers::pi,
                          static_cast<double>(start.evaluations)});
  }
  return table;
}

DataTable points_table(const design::Certificate& certificate) {
  DataTable table{{"operating point", "weight", "SSEE(h) / limit", "SSEE(z) / limit"}, {}};
  for (const design::CertifiedPoint& point : certificate.points)
    table.rows.push_back({point.model, point.weight, point.health_ratio, point.auxiliary_ratio});
  return table;
}

/// The first start is the closed form; the SVD's name begins so; the others are random.
LineSeries course_series(const SearchCourse& course, double best) {
  const bool random = course.start.starts_with("random"), svd = course.start.starts_with("SVD");
  LineSeries line{random ? "random starts" : course.start, {}, {}, random ? 3 : svd ? 2 : 1, Mark::line, random};
  for (std::size_t i = 0; i < course.objective.size(); ++i) {
    line.x.push_back(static_cast<double>(i + 1));
    line.y.push_back(std::max(course.objective[i] / best - 1.0, least_shown));
  }
  return line;
}

void add_courses(Section& section, const ReportData& data) {
  const std::vector<SearchCourse>& courses = data.studies.courses;
  if (courses.empty()) return;
  LineChart chart{.id = "search-courses",
                  .title = "Convergence of the starts",
                  .description =
                      "Relative distance of the best objective so far from that of the design, over the number of "
                      "evaluations, one line a start.",
                  .x = {"evaluations of the objective", true},
                  .y = {"J / J of the design − 1", true},
                  .series = {}};
  DataTable table{{"start", "evaluation", "best J"}, {}};
  // random ones first: the lines of the others lie on top
  for (auto course = courses.rbegin(); course != courses.rend(); ++course)
    chart.series.push_back(course_series(*course, data.design.certificate.objective));
  for (const SearchCourse& course : courses) {
    for (std::size_t i = 0; i < course.objective.size(); ++i)
      table.rows.push_back({course.start, static_cast<double>(i + 1), course.objective[i]});
  }
  section.add_figure(chart.id, "How the starts of the search converge.",
                     "Each line is one start; lines that fall to the bottom reach the design's own objective up to "
                     "rounding (drawn at 10⁻¹²), a line that stays above ends in another valley.",
                     responsive(chart), std::move(table));
}

}  // namespace

Section optimum_section(const ReportData& data) {
  const design::Certificate& certificate = data.design.certificate;
  Section section{"optimum", "Is it an optimum?"};
  section.add_text("The verdict is: " + certificate.verdict + ".");
  section.add_text(
      "Judged is J, the squared errors of health and of the auxiliary outputs, each over its Bayes limit, added with "
      "the weights that were given" +
      std::string(certificate.limit_is_prior ? "; where a limit vanishes, the fleet's own spread divides in its place"
                                             : "") +
      ". Only the space that the rows of V* span counts, so that slope and curvature are those on row spaces.");
  if (certificate.points.size() > 1)
    section.add_table("certified-points", "One V* for several operating points, squared errors over their limits",
                      points_table(certificate));
  add_courses(section, data);
  if (!certificate.starts.empty())
    section.add_table("starts", "Starts of the search and where they ended", starts_table(certificate));
  section.add_table("certificate", "Certificate", certificate_table(certificate));
  return section;
}

}  // namespace ehm::tuner_design::report
