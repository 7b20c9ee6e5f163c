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

/// What is asked of one kind of finding.
struct FindingAsked {
  Findings FleetResult::*of;
  const char *what, *kind, *name;  ///< with its size, without, and what is named
  double most_delay_s, most_landing;
};

/// How it was found, named, and survived.
void add_findings(const std::vector<FlightFleet>& fleets, const FindingAsked& asked,
                  std::vector<FlightFigure>& figures) {
  double happened = 0.0, found = 0.0, named = 0.0, delay_s = 0.0, false_alarms = 0.0, landing = 0.0;
  for (const FlightFleet& f : fleets) {
    const Findings& here = f.result.*asked.of;
    happened += static_cast<double>(here.happened);
    found += static_cast<double>(here.found);
    named += static_cast<double>(here.named);
    delay_s += static_cast<double>(here.found) * here.delay_s;
    false_alarms = std::max(false_alarms, here.false_alarms);
    if (here.happened > 0) landing = std::max(landing, f.result.ssee_landing);
  }
  if (happened == 0.0) return;
  const std::string what = std::string(asked.what) + ": ";
  const auto of_found = [&](double sum) { return found > 0.0 ? sum / found : 0.0; };
  figures.push_back({what + "found within a minute", found / happened, 0.95, {}});
  figures.push_back({what + "of those found, the " + asked.name + " named right", of_found(named), 0.90, {}});
  figures.push_back({what + "mean delay, s", of_found(delay_s), {}, asked.most_delay_s});
  figures.push_back({what + "SSEE at landing, worse fleet", landing, {}, asked.most_landing});
  figures.push_back(
      {std::string(asked.kind) + " found where there was none, a flight, worst fleet", false_alarms, {}, 0.2});
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
  add_findings(fleets, {&FleetResult::steps, "steps of 2 %", "steps", "parameter", 10.0, 5.0}, figures);
  add_findings(fleets, {&FleetResult::biases, "biases of 5 sigma", "biases", "sensor", 3.0, 8.0}, figures);
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
