// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/flight/flight_figures.h"

#include <algorithm>

namespace ehm::tuner_design {
namespace {

/// Fleets with all sensors come first.
constexpr std::size_t first_incomplete = 7;

FlightFleet fleet(const FlightStudyOptions& common, std::string name, const engine_sim::MismatchDraw& truth,
                  std::vector<std::size_t> missing = {}) {
  FlightFleet fleet{std::move(name), common, {}};
  fleet.options.draw.mismatch = truth;
  fleet.options.missing = std::move(missing);
  // the estimator looks for what its user expects of the truth
  fleet.options.onboard.build = truth.build;
  fleet.options.onboard.soak = truth.soak;
  fleet.options.onboard.inputs = truth.inputs;
  return fleet;
}

std::vector<FlightFleet> fleets_of(const FlightStudyOptions& common,
                                   const std::shared_ptr<const estimation::Estimator>& scheduled) {
  const engine_sim::MismatchDraw built{.build = true, .soak = true}, all{true, true, true};
  std::vector<FlightFleet> fleets{fleet(common, "as filed", {}),
                                  fleet(common, "build, soak", built),
                                  fleet(common, "all", all),
                                  fleet(common, "step in cruise", built),
                                  fleet(common, "step in climb", built),
                                  fleet(common, "bias in cruise", built),
                                  fleet(common, "bias in climb", built)};
  fleets[3].options.draw.step = StepOfHealth{2500.0, 2.0};
  fleets[4].options.draw.step = StepOfHealth{900.0, 2.0};
  fleets[5].options.draw.bias = BiasOfSensor{2500.0, 5.0};
  fleets[6].options.draw.bias = BiasOfSensor{900.0, 5.0};
  const auto& sensors = common.engine->channels.sensors;
  for (std::size_t i = 0; i < sensors.size(); ++i)
    fleets.push_back(fleet(common, "without " + std::string(sensors[i].quantity->name), built, {i}));
  if (sensors.size() > 3)
    fleets.push_back(fleet(
        common, "without " + std::string(sensors[2].quantity->name) + ", " + std::string(sensors.back().quantity->name),
        built, {2, sensors.size() - 1}));
  if (scheduled) {
    fleets.push_back(fleet(common, "scheduled, as filed", {}));
    fleets.push_back(fleet(common, "scheduled, build, soak", built));
    for (std::size_t i = fleets.size() - 2; i < fleets.size(); ++i) fleets[i].options.estimator = scheduled;
  }
  return fleets;
}

double least_of(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::min_element(values.begin(), values.end());
}

double greatest_of(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

/// How steps were found, named, and survived.
void add_step_figures(const std::vector<FlightFleet>& fleets, std::vector<FlightFigure>& figures) {
  double steps = 0.0, found = 0.0, named = 0.0, delay_s = 0.0, false_alarms = 0.0, landing = 0.0;
  for (const FlightFleet& f : fleets) {
    const auto found_here = static_cast<double>(f.result.steps_found);
    steps += static_cast<double>(f.result.steps);
    found += found_here;
    named += static_cast<double>(f.result.steps_named);
    delay_s += found_here * f.result.step_delay_s;
    false_alarms = std::max(false_alarms, f.result.false_steps);
    if (f.result.steps > 0) landing = std::max(landing, f.result.ssee_landing);
  }
  if (steps == 0.0) return;
  figures.push_back({"steps of 2 %: found within a minute", found / steps, 0.95, {}});
  figures.push_back(
      {"steps of 2 %: of those found, the parameter named right", found > 0.0 ? named / found : 0.0, 0.90, {}});
  figures.push_back({"steps of 2 %: mean delay, s", found > 0.0 ? delay_s / found : 0.0, {}, 10.0});
  figures.push_back({"steps of 2 %: SSEE at landing, worse fleet", landing, {}, 5.0});
  figures.push_back({"steps found where there was none, a flight, worst fleet", false_alarms, {}, 0.2});
}

/// The same of sensors.
void add_bias_figures(const std::vector<FlightFleet>& fleets, std::vector<FlightFigure>& figures) {
  double biases = 0.0, found = 0.0, named = 0.0, delay_s = 0.0, false_alarms = 0.0, landing = 0.0;
  for (const FlightFleet& f : fleets) {
    const auto found_here = static_cast<double>(f.result.biases_found);
    biases += static_cast<double>(f.result.biases);
    found += found_here;
    named += static_cast<double>(f.result.biases_named);
    delay_s += found_here * f.result.bias_delay_s;
    false_alarms = std::max(false_alarms, f.result.false_biases);
    if (f.result.biases > 0) landing = std::max(landing, f.result.ssee_landing);
  }
  if (biases == 0.0) return;
  figures.push_back({"biases of 5 sigma: found within a minute", found / biases, 0.95, {}});
  figures.push_back(
      {"biases of 5 sigma: of those found, the sensor named right", found > 0.0 ? named / found : 0.0, 0.90, {}});
  figures.push_back({"biases of 5 sigma: mean delay, s", found > 0.0 ? delay_s / found : 0.0, {}, 3.0});
  figures.push_back({"biases of 5 sigma: SSEE at landing, worse fleet", landing, {}, 8.0});
  figures.push_back({"biases found where there was none, a flight, worst fleet", false_alarms, {}, 0.2});
}

/// What is asked of the estimator, beside what the fleets gave.
std::vector<FlightFigure> figures_of(const std::vector<FlightFleet>& fleets) {
  const FleetResult &filed = fleets[0].result, &built = fleets[1].result, &all = fleets[2].result;
  double estimated = 1.0, covered = 1.0;
  std::size_t incomplete = 0;
  for (std::size_t i = 0; i < fleets.size(); ++i) {
    estimated = std::min(estimated, fleets[i].result.estimated);
    if (i < first_incomplete || fleets[i].options.estimator) continue;
    covered = std::min(covered, fleets[i].result.health_coverage);
    ++incomplete;
  }
  const auto ratio = [](const FleetResult& r) { return r.ssee_landing > 0.0 ? r.claim_landing / r.ssee_landing : 0.0; };
  std::vector<FlightFigure> figures{
      {"samples with estimates, taxi included, every fleet", estimated, 0.99, {}},
      {"as filed: SSEE at 700 s", filed.ssee_700, {}, 0.5},
      {"as filed: SSEE at landing", filed.ssee_landing, {}, 0.1},
      {"build, soak: SSEE at landing", built.ssee_landing, {}, 5.0},
      {"build, soak: pooled coverage of health", built.health_coverage, 0.92, 0.99},
      {"build, soak: claims over SSEE at landing", ratio(built), 0.7, 1.6},
      {"all: SSEE at landing", all.ssee_landing, {}, 8.0},
      {"all: pooled coverage of health", all.health_coverage, 0.90, 0.98},
      {"all: coverage of the worst health channel", all.worst_health_coverage, 0.85, {}},
      {"all: worst coverage of an auxiliary output, steady", least_of(all.steady_coverage), 0.92, {}},
      {"all: best coverage of an auxiliary output, steady", greatest_of(all.steady_coverage), {}, 0.98},
      {"all: worst coverage of an auxiliary output, 30 s after a slam", least_of(all.slam_coverage), 0.90, {}}};
  add_step_figures(fleets, figures);
  add_bias_figures(fleets, figures);
  if (incomplete > 0)
    figures.push_back({"one or two sensors missing: pooled coverage, worst fleet", covered, 0.88, {}});
  for (const FlightFleet& f : fleets) {
    if (!f.options.estimator) continue;
    figures.push_back({f.name + ": SSEE at landing", f.result.ssee_landing, {}, 6.0});
    figures.push_back({f.name + ": coverage of the worst health channel", f.result.worst_health_coverage, 0.90, {}});
  }
  return figures;
}

}  // namespace

FlightStudy run_flight_study(const FlightStudyOptions& common,
                             const std::shared_ptr<const estimation::Estimator>& scheduled,
                             const std::function<void(double)>& progress) {
  FlightStudy study;
  for (const auto& channel : common.engine->channels.health)
    study.health.emplace_back(engine_sim::health_names[channel.parameter]);
  for (const auto* output : common.engine->channels.auxiliary) study.auxiliary.emplace_back(output->name);
  study.fleets = fleets_of(common, scheduled);
  for (std::size_t i = 0; i < study.fleets.size(); ++i) {
    const auto of_all = static_cast<double>(study.fleets.size());
    study.fleets[i].result =
        fly_fleet(study.fleets[i].options, [&](double share) { progress((static_cast<double>(i) + share) / of_all); });
  }
  study.figures = figures_of(study.fleets);
  return study;
}

}  // namespace ehm::tuner_design
