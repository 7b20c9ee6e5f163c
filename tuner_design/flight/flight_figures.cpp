// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/flight/flight_figures.h"

#include <algorithm>

namespace ehm::tuner_design {
namespace {

FlightFleet fleet(const FlightStudyOptions& common, std::string name, const engine_sim::MismatchDraw& truth,
                  std::vector<std::size_t> missing = {}) {
  FlightFleet fleet{std::move(name), common, {}};
  fleet.options.mismatch = truth;
  fleet.options.missing = std::move(missing);
  // the estimator looks for what its user expects of the truth
  fleet.options.onboard.build = truth.build;
  fleet.options.onboard.soak = truth.soak;
  fleet.options.onboard.inputs = truth.inputs;
  return fleet;
}

std::vector<FlightFleet> fleets_of(const FlightStudyOptions& common) {
  const engine_sim::MismatchDraw built{.build = true, .soak = true}, all{true, true, true};
  std::vector<FlightFleet> fleets{fleet(common, "as filed", {}), fleet(common, "build, soak", built),
                                  fleet(common, "all", all)};
  const auto& sensors = common.engine->channels.sensors;
  for (std::size_t i = 0; i < sensors.size(); ++i)
    fleets.push_back(fleet(common, "without " + std::string(sensors[i].quantity->name), built, {i}));
  if (sensors.size() > 3)
    fleets.push_back(fleet(
        common, "without " + std::string(sensors[2].quantity->name) + ", " + std::string(sensors.back().quantity->name),
        built, {2, sensors.size() - 1}));
  return fleets;
}

double least_of(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::min_element(values.begin(), values.end());
}

double greatest_of(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

/// What is asked of the estimator, beside what the fleets gave.
std::vector<FlightFigure> figures_of(const std::vector<FlightFleet>& fleets) {
  const FleetResult &filed = fleets[0].result, &built = fleets[1].result, &all = fleets[2].result;
  double estimated = 1.0, covered = 1.0;
  for (const FlightFleet& f : fleets) estimated = std::min(estimated, f.result.estimated);
  for (std::size_t i = 3; i < fleets.size(); ++i) covered = std::min(covered, fleets[i].result.health_coverage);
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
  if (fleets.size() > 3)
    figures.push_back({"one or two sensors missing: pooled coverage, worst fleet", covered, 0.88, {}});
  return figures;
}

}  // namespace

FlightStudy run_flight_study(const FlightStudyOptions& common, const std::function<void(double)>& progress) {
  FlightStudy study;
  for (const auto& channel : common.engine->channels.health)
    study.health.emplace_back(engine_sim::health_names[channel.parameter]);
  for (const auto* output : common.engine->channels.auxiliary) study.auxiliary.emplace_back(output->name);
  study.fleets = fleets_of(common);
  for (std::size_t i = 0; i < study.fleets.size(); ++i) {
    const auto of_all = static_cast<double>(study.fleets.size());
    study.fleets[i].result =
        fly_fleet(study.fleets[i].options, [&](double share) { progress((static_cast<double>(i) + share) / of_all); });
  }
  study.figures = figures_of(study.fleets);
  return study;
}

}  // namespace ehm::tuner_design
