// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/print/studies/kosanam_text.h"

#include <fmt/format.h>

#include <array>
#include <ostream>

#include "deploy/runtime/numbers/index.h"

namespace ehm::tuner_design {
namespace {

std::vector<double> values(const Eigen::VectorXd& v) {
  return {v.begin(), v.end()};
}

void print_not_known(const std::vector<std::string>& names, std::ostream& out) {
  for (const std::string& name : names)
    out << fmt::format("  {} is not in the wear table: it wears as fan_efficiency does\n", name);
}

void print_batches(const std::string& model, const BatchOptions& batch, double health_variance, std::ostream& out) {
  out << fmt::format(
      "{}: {} runs of {} flights, {} samples each; linear truth; health wears {}\n"
      "(the thesis: DIGTEM, 16 states, 12 sensors); qh {:.3g} percent^2 a sample\n\n",
      model, batch.runs, batch.flights, batch.samples,
      batch.equal_wear_percent > 0.0 ? fmt::format("by {:g} % each", batch.equal_wear_percent)
                                     : "to the end of the wear table",
      health_variance);
}

/// A result for a parameter of each filter.
std::string csv_lines(const std::string& head, const BatchResult& result, const std::vector<std::string>& health) {
  std::string lines;
  for (std::size_t f = 0; f < result.filters.size(); ++f)
    for (std::size_t i = 0; i < health.size(); ++i) {
      const BatchErrors& errors = result.filters[f];
      const Eigen::Index at = as_index(i);
      lines += fmt::format("{},\"{}\",{},{:.6g},{:.6g},{:.6g},{:.6g}\n", head, errors.name, health[i], errors.rms(at),
                           result.of_change(f, at), errors.bias(at), errors.coverage(at));
    }
  return lines;
}

constexpr const char* csv_columns = "filter,parameter,rms_percent,rms_percent_of_change,bias_percent,coverage\n";

nlohmann::ordered_json result_as_json(const BatchResult& result) {
  nlohmann::ordered_json filters = nlohmann::ordered_json::array();
  for (const BatchErrors& f : result.filters)
    filters.push_back({{"filter", f.name},
                       {"rms_percent", values(f.rms)},
                       {"bias_percent", values(f.bias)},
                       {"coverage", values(f.coverage)}});
  return {{"change_percent", values(result.change)}, {"filters", std::move(filters)}};
}

/// Published beside ours, parameter by parameter, then the averages; of four filters the shown ones.
void print_table_5_1(const ConstrainedTables& t, std::ostream& out) {
  const BatchResult& r = t.table();
  out << "Table 5.1: RMS errors of health, percent of its change\n"
      << fmt::format("  {:<18}{:>30}{:>44}\n", "", "published", "ours")
      << fmt::format("  {:<18}{:>10}{:>12}{:>8}{:>12}{:>8}{:>8}{:>10}{:>8}\n", "", "Kalman", "constrained", "ratio",
                     "Kalman", "W = I", "ratio", "W = P^-1", "ratio");
  const auto line = [&](const std::string& name, double kf, double constrained, double ours, double by_identity,
                        double by_covariance) {
    const std::string theirs = kf > 0.0 ? fmt::format("{:>10.1f}{:>12.1f}{:>8.2f}", kf, constrained, constrained / kf)
                                        : fmt::format("{:>30}", "");
    out << fmt::format("  {:<18}{}{:>12.2f}{:>8.2f}{:>8.2f}{:>10.2f}{:>8.2f}\n", name, theirs, ours, by_identity,
                       by_identity / ours, by_covariance, by_covariance / ours);
  };
  for (std::size_t i = 0; i < t.health.size(); ++i) {
    const auto at = as_index(i);
    const bool known = i < published_5_1.size() && t.health.size() == published_5_1.size();
    line(t.health[i], known ? published_5_1[i][0] : 0.0, known ? published_5_1[i][1] : 0.0,
         r.of_change(constrained_case::kalman, at), r.of_change(constrained_case::identity, at),
         r.of_change(constrained_case::projection, at));
  }
  line("average", published_5_1_average[0], published_5_1_average[1], r.of_change(constrained_case::kalman),
       r.of_change(constrained_case::identity), r.of_change(constrained_case::projection));
}

void print_all_filters(const ConstrainedTables& t, std::ostream& out) {
  const BatchResult& r = t.table();
  out << fmt::format("\n  {:<36}{:>12}{:>12}{:>11}{:>10}{:>10}\n", "all filters, mean over parameters", "% nominal",
                     "% of change", "ratio", "bias", "coverage");
  for (std::size_t f = 0; f < r.filters.size(); ++f)
    out << fmt::format("  {:<36}{:>12.4f}{:>12.2f}{:>11.3f}{:>10.4f}{:>10.3f}\n", r.filters[f].name, r.mean_rms(f),
                       r.of_change(f), r.mean_rms(f) / r.mean_rms(constrained_case::kalman), r.filters[f].bias.mean(),
                       r.filters[f].coverage.mean());
  out << "  ratio: to the steady Kalman filter, of percent nominal (published, of its percent: 0.80); bias: percent\n"
         "  nominal, the way of wear; coverage: of 1.96 of the sigma that each states, honest is 0.95\n"
      << fmt::format("  figure 5.1, time-varying over steady: {:.3f}\n", t.ratio(constrained_case::time_varying));
}

void print_sweep(const ConstrainedTables& t, std::ostream& out) {
  using namespace constrained_case;
  constexpr std::array shown{
      kalman, identity, projection, identity_fed_back, projection_behind_fed_back, truncation_2_behind};
  out << "\n  the ratchet over qh: rms (bias), percent nominal; of the truncation its coverage besides\n"
      << fmt::format("  {:<8}", "qh x");
  for (const Case f : shown) {
    const std::string& name = t.table().filters[f].name;
    out << fmt::format("{:>22}", name.size() > 20 ? name.substr(0, 19) + "." : name);
  }
  out << '\n';
  for (const SweepPoint& point : t.sweep) {
    out << fmt::format("  {:<8g}", point.factor);
    for (const Case f : shown)
      out << fmt::format(
          "{:>22}", fmt::format("{:.3f} ({:+.3f})", point.result.mean_rms(f), point.result.filters[f].bias.mean()));
    out << fmt::format("{:>8.3f}\n", point.result.filters[truncation_2_behind].coverage.mean());
  }
}

}  // namespace

void print_constrained_tables(const ConstrainedTables& t, std::ostream& out) {
  print_batches(t.model, t.options.batch, t.options.health_variance * t.sweep[t.best].factor, out);
  print_not_known(t.not_known, out);
  print_table_5_1(t, out);
  print_all_filters(t, out);
  print_sweep(t, out);
}

nlohmann::ordered_json constrained_tables_as_json(const ConstrainedTables& t) {
  nlohmann::ordered_json sweep = nlohmann::ordered_json::array();
  for (const SweepPoint& point : t.sweep) {
    nlohmann::ordered_json one = result_as_json(point.result);
    one["factor"] = point.factor;
    sweep.push_back(std::move(one));
  }
  return {{"model", t.model},
          {"health", t.health},
          {"health_variance", t.options.health_variance},
          {"best_factor", t.sweep[t.best].factor},
          {"ratio_identity", t.ratio(constrained_case::identity)},
          {"ratio_projection", t.ratio(constrained_case::projection)},
          {"published_ratio", published_5_1_average[1] / published_5_1_average[0]},
          {"sweep", std::move(sweep)}};
}

std::string constrained_tables_csv(const ConstrainedTables& t) {
  std::string text = std::string("qh_factor,") + csv_columns;
  for (const SweepPoint& point : t.sweep) text += csv_lines(fmt::format("{:g}", point.factor), point.result, t.health);
  return text;
}

namespace {

void print_robust_table(const RobustTables& t, double noise, const std::array<std::array<double, 2>, 8>& published,
                        const std::array<double, 2>& average, std::ostream& out) {
  const BatchResult& r = t.at(noise);
  out << fmt::format("  {:<18}{:>26}{:>46}\n", "", "published", "ours, percent of change")
      << fmt::format("  {:<18}{:>10}{:>10}{:>8}{:>12}{:>10}{:>8}{:>12}{:>8}\n", "", "standard", "robust", "ratio",
                     "standard", "mixed", "ratio", "robust", "ratio");
  const auto line = [&](const std::string& name, const std::string& theirs, double ours, double mixed, double robust) {
    out << fmt::format("  {:<18}{:>28}{:>12.2f}{:>10.2f}{:>8.3f}{:>12.2f}{:>8.3f}\n", name, theirs, ours, mixed,
                       mixed / ours, robust, robust / ours);
  };
  const auto shown = [](const std::array<double, 2>& p) {
    return fmt::format("{:>10.1f}{:>10.1f}{:>8.3f}", p[0], p[1], p[1] / p[0]);
  };
  for (std::size_t i = 0; i < t.health.size(); ++i)
    line(t.health[i], t.health.size() == published.size() ? shown(published[i]) : "",
         r.of_change(robust_case::standard, as_index(i)), r.of_change(robust_case::mixed, as_index(i)),
         r.of_change(robust_case::robust, as_index(i)));
  line("average", shown(average), r.of_change(robust_case::standard), r.of_change(robust_case::mixed),
       r.of_change(robust_case::robust));
}

}  // namespace

void print_robust_tables(const RobustTables& t, std::ostream& out) {
  const RobustTablesOptions& o = t.options;
  print_batches(t.model, o.batch, o.health_variance * t.factor, out);
  print_not_known(t.not_known, out);
  out << fmt::format(
      "Robust gain: Kalman gain for R x {:.4g}, optimum of J for rho2/rho1 = {:g} per percent^2; J {:.4g} -> {:.4g}, "
      "{:.0f} %\n(figure 5.4: -80 %); mixed: {:g} standard + {:g} robust, as the thesis had to\n",
      t.mu, o.rho2, t.standard_objective, t.robust_objective, 100.0 * (t.robust_objective / t.standard_objective - 1.0),
      o.eta, 1.0 - o.eta);
  out << "\nTable 5.2: the sensors' variance is nine times the model's\n";
  print_robust_table(t, 9.0, published_5_2, published_5_2_average, out);
  out << "\nTable 5.3: the noise is the model's\n";
  print_robust_table(t, 1.0, published_5_3, published_5_3_average, out);
  out << fmt::format("\nFigure 5.6: mean error, percent nominal\n  {:<18}{:>10}{:>10}{:>10}\n", "variance x",
                     "standard", "mixed", "robust");
  for (std::size_t k = 0; k < o.noise_factors.size(); ++k)
    out << fmt::format("  {:<18g}{:>10.4f}{:>10.4f}{:>10.4f}\n", o.noise_factors[k],
                       t.by_noise[k].mean_rms(robust_case::standard), t.by_noise[k].mean_rms(robust_case::mixed),
                       t.by_noise[k].mean_rms(robust_case::robust));
}

nlohmann::ordered_json robust_tables_as_json(const RobustTables& t) {
  nlohmann::ordered_json by_noise = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < t.by_noise.size(); ++k) {
    nlohmann::ordered_json one = result_as_json(t.by_noise[k]);
    one["noise_factor"] = t.options.noise_factors[k];
    by_noise.push_back(std::move(one));
  }
  return {{"model", t.model},
          {"health", t.health},
          {"mu", t.mu},
          {"rho2", t.options.rho2},
          {"eta", t.options.eta},
          {"standard_objective", t.standard_objective},
          {"robust_objective", t.robust_objective},
          {"by_noise", std::move(by_noise)}};
}

std::string robust_tables_csv(const RobustTables& t) {
  std::string text = std::string("noise_factor,") + csv_columns;
  for (std::size_t k = 0; k < t.by_noise.size(); ++k)
    text += csv_lines(fmt::format("{:g}", t.options.noise_factors[k]), t.by_noise[k], t.health);
  return text;
}

void print_gain_search(const GainSearch& s, std::ostream& out) {
  const GainSearchOptions& o = s.options;
  out << fmt::format(
      "Vehicle on a straight line, position measured: error of position, ft, on {} runs that the search has not seen\n"
      "(NLopt GN_ESCH, {} evaluations of {} runs; the thesis: a genetic algorithm of its own, without numbers)\n\n"
      "  {:<12}{:<10}{:>10}{:>10}{:>10}{:>10}{:>12}\n",
      o.test_runs, o.evaluations, o.training_runs, "uncertain", "gain", "K1", "K2, 1/s", "error", "saved", "published");
  for (const GainSearchRow& row : s.rows)
    for (std::size_t i = 0; i < row.gains.size(); ++i) {
      const double published = i == 0 ? 0.0 : i == 1 ? row.published_robust : row.published_searched;
      out << fmt::format("  {:<12}{:<10}{:>10.4f}{:>10.4f}{:>10.3f}{:>9.1f}%{:>12}\n", row.uncertainty,
                         row.gains[i].name, row.gains[i].K(0), row.gains[i].K(1), row.gains[i].error_ft,
                         100.0 * row.saved(i), published > 0.0 ? fmt::format("{:.0f}%", 100.0 * published) : "");
    }
  out << "\n  Where only variances are uncertain around what the model says, the Kalman gain is nearly the best there "
         "is;\n"
         "  83 % need a filter whose noise is wrong from the start. A model that is wrong is where a search helps.\n";
}

nlohmann::ordered_json gain_search_as_json(const GainSearch& s) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const GainSearchRow& row : s.rows)
    for (std::size_t i = 0; i < row.gains.size(); ++i)
      rows.push_back({{"uncertainty", row.uncertainty},
                      {"gain", row.gains[i].name},
                      {"K", values(row.gains[i].K)},
                      {"error_ft", row.gains[i].error_ft},
                      {"saved", row.saved(i)}});
  return {{"evaluations", s.options.evaluations}, {"gains", std::move(rows)}};
}

std::string gain_search_csv(const GainSearch& s) {
  std::string text = "uncertainty,gain,k1,k2_per_s,error_ft,saved\n";
  for (const GainSearchRow& row : s.rows)
    for (std::size_t i = 0; i < row.gains.size(); ++i)
      text += fmt::format("{},{},{:.6g},{:.6g},{:.6g},{:.6g}\n", row.uncertainty, row.gains[i].name, row.gains[i].K(0),
                          row.gains[i].K(1), row.gains[i].error_ft, row.saved(i));
  return text;
}

}  // namespace ehm::tuner_design
