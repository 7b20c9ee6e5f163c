// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/baselines/baselines.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <stdexcept>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/discretise.h"
#include "tuner_design/baselines/best_subset.h"
#include "tuner_design/design/choose_tuners.h"
#include "tuner_design/design/tuner_baselines.h"
#include "tuner_design/full_order/gauss_markov.h"
#include "tuner_design/full_order/limit_after.h"
#include "tuner_design/theory/bayes_limit.h"

namespace ehm::tuner_design {
namespace {

using design::Design;
using estimation::SteadyGain;
using linear_model::LinearModel;

/// The design's model, discrete and scaled, on the linear truth.
struct Setting {
  LinearModel model;
  SteadyGain steady;
  double qh = 0.0;
  Eigen::Index tuners = 0;
};

Setting setting_of(const Design& design) {
  Setting setting;
  setting.model = linear_model::scaled(discretise(design.model), design.scaling);
  setting.model.linearisation_error.resize(0, 0);
  setting.steady = estimation::steady_gain(setting.model);
  setting.qh = design.options.qh_percent2;
  setting.tuners = design.full.V.rows();
  return setting;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

Baseline of_filter(std::string name, std::string description, const design::SubsetDesign& filter) {
  return {std::move(name), std::move(description), linear_error(filter), filter.slowest_time_constant_s};
}

void add_best_subset(std::vector<Baseline>& table, const Setting& setting, const design::ErrorWeights& weights,
                     const BaselineOptions& options) {
  const RelativeError merit = relative_error(setting.model, setting.steady, weights);
  const auto best = best_subset(setting.model, setting.steady, static_cast<int>(setting.tuners), setting.qh, merit,
                                options.threads, options.progress);
  if (!best) return;
  std::vector<std::string> names;
  for (const int i : best->health) names.push_back(setting.model.health[as_size(i)].name);
  table.push_back(of_filter(
      "best_subset", "best of all " + std::to_string(best->subsets) + " subsets: " + joined(names), best->filter));
}

void add_published_subset(std::vector<Baseline>& table, const Setting& setting) {
  const std::vector<std::string> names = published_subset(setting.model);
  if (names.empty()) return;
  const auto filter = filter_on_tuners(setting.model, setting.steady, subset_tuners(setting.model, names), setting.qh);
  if (filter) table.push_back(of_filter("published_subset", "Simon & Garg's subset: " + joined(names), *filter));
}

void add_named_subset(std::vector<Baseline>& table, const Setting& setting, const std::vector<std::string>& names) {
  if (names.empty()) return;
  if (std::set<std::string>(names.begin(), names.end()).size() != names.size()) {
    throw std::invalid_argument("subset of tuners: a health parameter is named twice in " + joined(names));
  }
  const auto filter = filter_on_tuners(setting.model, setting.steady, subset_tuners(setting.model, names), setting.qh);
  if (!filter) {
    throw std::runtime_error("subset of tuners: the " + std::to_string(setting.model.sensors.size()) +
                             " sensors cannot tell " + joined(names) + " apart; name fewer or others");
  }
  table.push_back(of_filter("named_subset", "subset as named: " + joined(names), *filter));
}

void add_reduced(std::vector<Baseline>& table, const Setting& setting, const design::ErrorWeights& weights,
                 const BaselineOptions& options) {
  const Eigen::MatrixXd R = setting.model.sensor_noise_sigma.cwiseAbs2().asDiagonal();
  const Eigen::MatrixXd V = closed_form_tuners(setting.steady.H, R, setting.model.health_sigma, setting.tuners);
  if (const auto filter = filter_on_tuners(setting.model, setting.steady, V, setting.qh))
    table.push_back(of_filter("closed_form", "Kalman filter on V = H Ph", *filter));
  add_best_subset(table, setting, weights, options);
  add_published_subset(table, setting);
  const Eigen::MatrixXd svd = svd_tuners(setting.steady.H, setting.steady.Hz, setting.tuners);
  if (const auto filter = filter_on_tuners(setting.model, setting.steady, svd, setting.qh))
    table.push_back(of_filter("svd", "Kalman filter on the SVD of [H; Hz], reporting units", *filter));
}

void add_gauss_markov(std::vector<Baseline>& table, const Setting& setting) {
  if (setting.qh >= setting.model.health_sigma.cwiseAbs2().mean()) return;  // no memory is as short as that
  const double rho = gauss_markov_rho(setting.model, setting.qh);
  std::ostringstream text;
  text << "full-order Gauss-Markov Kalman filter, 1 - rho = " << 1.0 - rho << ", that forgets in "
       << -setting.model.sample_time_s / std::log(rho) << " s";
  table.push_back(of_filter("gauss_markov", text.str(), gauss_markov_design(setting.model, setting.steady, rho)));
}

void add_time_varying(std::vector<Baseline>& table, const Setting& setting, double run_s) {
  constexpr double longest = 1e6;
  const double samples = std::round(run_s / setting.model.sample_time_s);
  if (!(samples >= 1.0 && samples <= longest)) {
    std::ostringstream message;
    message << "run_s is " << run_s << " s, " << samples << " samples of " << setting.model.sample_time_s
            << " s; allowed: 1 to 1000000 samples";
    throw std::invalid_argument(message.str());
  }
  std::ostringstream text;
  text << "full-order time-varying Kalman filter after " << samples << " samples, " << run_s << " s";
  table.push_back({"time_varying", text.str(), limit_after(setting.model, static_cast<int>(samples)), std::nullopt});
}

}  // namespace

std::size_t subsets_to_try(const Design& design) {
  const Eigen::Index t = design.full.V.rows(), p = design.full.V.cols();
  std::size_t count = 1;
  for (Eigen::Index i = 1; i <= t; ++i) count = count * as_size(p - t + i) / as_size(i);
  return t < p ? count : 0;
}

std::vector<Baseline> baselines(const Design& design, const BaselineOptions& options) {
  const Setting setting = setting_of(design);
  std::vector<Baseline> table;
  table.push_back({"design", "this design, " + std::to_string(setting.tuners) + " tuners", design.ssee,
                   design.full.slowest_time_constant_s});
  if (setting.tuners < design.full.V.cols()) add_reduced(table, setting, design.options.weights, options);
  add_named_subset(table, setting, options.named_subset);
  table.push_back({"full_map", "full-order MAP on one noisy snapshot", design.full_map, std::nullopt});
  add_gauss_markov(table, setting);
  add_time_varying(table, setting, options.run_s);
  table.push_back({"bayes_limit", "Bayes limit: endless averaging at this point",
                   steady_limit(design::fleet_unknowns(setting.model, setting.steady)), std::nullopt});
  return table;
}

}  // namespace ehm::tuner_design
