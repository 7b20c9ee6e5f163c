// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/print/studies/lu_text.h"

#include <fmt/format.h>

#include <optional>
#include <ostream>

#include "tuner_design/lu/published_beside.h"

namespace ehm::tuner_design {
namespace {

std::string figure_text(const std::optional<double>& value) {
  if (!value) return "";
  return *value < 0.0 ? "diverged" : fmt::format("{:.3f}", *value);
}

void print_parameters(const LuStudy& s, std::ostream& out) {
  out << fmt::format("  {:<38}{:<7}", "case", "filter");
  for (const char* name : lu_health_names) out << fmt::format("{:>9}", name);
  out << fmt::format("{:>9}{:>9}\n", "SME", "spread");
  const auto line = [&](const std::string& what, const std::string& filter, const auto& values) {
    out << fmt::format("  {:<38}{:<7}", what, filter);
    for (std::size_t i = 0; i < lu_health_count; ++i) out << fmt::format("{:>9.4f}", values[i]);
  };
  for (const LuCase& c : s.cases) {
    line(c.what, filter_name(c), std::vector<double>(c.mean_rms.begin(), c.mean_rms.end()));
    out << fmt::format("{:>9.3f}{:>9.3f}{}\n", c.sme, c.sme_spread,
                       c.diverged ? fmt::format("  {} of {} diverged", c.diverged, s.options.runs) : "");
    line("", "  sd", std::vector<double>(c.sigma_rms.begin(), c.sigma_rms.end()));
    out << '\n';
    if (const published::Lu* p = published_parameters(s, c)) {
      line("  the paper's, its one run", filter_name(c), p->mean);
      out << fmt::format("{:>9.3f}\n", sum_of_means(*p));
      line("", "  sd", p->sigma);
      out << '\n';
    }
  }
}

void print_figures(const LuStudy& s, std::ostream& out) {
  const bool cost = s.options.table == 7;
  out << fmt::format("  {:<40}{:<8}{:>12}{:>10}{:>12}\n", "case", "filter", cost ? "s a s" : "SME, percent",
                     cost ? "" : "spread", "the paper's");
  for (std::size_t i = 0; i < s.cases.size(); ++i) {
    const LuCase& c = s.cases[i];
    out << fmt::format("  {:<40}{:<8}{:>12}{:>10}{:>12}{}\n", c.what, filter_name(c),
                       fmt::format("{:.4f}", cost ? c.seconds : c.sme), cost ? "" : fmt::format("{:.3f}", c.sme_spread),
                       figure_text(published_figure(s, i)),
                       c.diverged ? fmt::format("  {} of {} diverged", c.diverged, s.options.runs) : "");
  }
}

}  // namespace

void print_lu_study(const LuStudy& s, std::ostream& out) {
  out << fmt::format(
      "Lu, Huang & Lv, table {}: on {} at sea level, {:.3f} kg/s of fuel (theirs: 2.5), {} runs where the paper has "
      "one, "
      "N = {}, seed {}\n"
      "Errors of health in percent of nominal over samples 401 to 500; means and sd: root mean squares over the "
      "runs\n\n",
      s.options.table, s.options.engine->data.name, s.fuel_flow_kg_s, s.options.runs, s.options.particles,
      s.options.seed);
  if (s.options.table <= 5)
    print_parameters(s, out);
  else
    print_figures(s, out);
}

nlohmann::ordered_json lu_study_as_json(const LuStudy& s) {
  nlohmann::ordered_json cases = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < s.cases.size(); ++i) {
    const LuCase& c = s.cases[i];
    nlohmann::ordered_json json{{"case", c.what},
                                {"filter", filter_name(c)},
                                {"mean_rms_percent", std::vector<double>(c.mean_rms.begin(), c.mean_rms.end())},
                                {"sd_percent", std::vector<double>(c.sigma_rms.begin(), c.sigma_rms.end())},
                                {"sme_percent", c.sme},
                                {"sme_spread_percent", c.sme_spread},
                                {"diverged", c.diverged}};
    if (s.options.table == 7) json["seconds_a_second"] = c.seconds;
    if (const auto p = published_figure(s, i)) json["published"] = *p;
    cases.push_back(std::move(json));
  }
  return {{"table", s.options.table},           {"engine", s.options.engine->data.name},
          {"fuel_flow_kg_s", s.fuel_flow_kg_s}, {"runs", s.options.runs},
          {"particles", s.options.particles},   {"seed", s.options.seed},
          {"health", lu_health_names},          {"cases", cases}};
}

std::string lu_study_as_csv(const LuStudy& s) {
  std::string csv = "case,filter,time_s";
  for (const char* name : lu_health_names) csv += fmt::format(",{}_percent", name);
  csv += '\n';
  for (const LuCase& c : s.cases) {
    for (std::size_t k = 0; k < c.first_estimates.size(); ++k) {
      csv += fmt::format("\"{}\",{},{:.2f}", c.what, filter_name(c), lu_filter_step_s * static_cast<double>(k));
      for (const double h : c.first_estimates[k]) csv += fmt::format(",{:.5f}", h);
      csv += '\n';
    }
  }
  return csv;
}

}  // namespace ehm::tuner_design
