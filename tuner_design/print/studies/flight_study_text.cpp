// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/print/studies/flight_study_text.h"

#include <fmt/format.h>

#include <ostream>

namespace ehm::tuner_design {
namespace {

std::string asked(const FlightFigure& f) {
  if (f.least && f.most) return fmt::format("{:g} to {:g}", *f.least, *f.most);
  if (f.least) return fmt::format("at least {:g}", *f.least);
  return fmt::format("at most {:g}", *f.most);
}

void print_shares(std::ostream& out, const std::vector<std::string>& names, const std::vector<double>& shares) {
  for (std::size_t i = 0; i < shares.size(); ++i) out << fmt::format(" {} {:.3f}", names[i], shares[i]);
  out << '\n';
}

nlohmann::ordered_json findings_as_json(const Findings& f) {
  return {{"happened", f.happened},
          {"found", f.found},
          {"named", f.named},
          {"delay_s", f.delay_s},
          {"false_alarms", f.false_alarms}};
}

}  // namespace

void print_flight_study(const FlightStudy& study, std::ostream& out) {
  const FlightStudyOptions& common = study.fleets.front().options;
  out << fmt::format("Flight study: fleets of {} engines {} over the two-hour mission, step {:g} s, seed {}\n\n",
                     common.engines, common.engine->data.name, common.step_s, common.draw.seed);
  out << fmt::format("  {:<26}{:>7}{:>8}{:>11}{:>9}{:>10}{:>9}{:>8}{:>9}{:>8}\n", "truth", "flown", "with %",
                     "SSEE 700 s", "claims", "landing", "claims", "worst", "coverage", "worst");
  for (const FlightFleet& f : study.fleets) {
    const FleetResult& r = f.result;
    out << fmt::format("  {:<26}{:>7}{:>8.2f}{:>11.3f}{:>9.3f}{:>10.3f}{:>9.3f}{:>8.2f}{:>9.3f}{:>8.3f}\n", f.name,
                       r.flown, 100.0 * r.estimated, r.ssee_700, r.claim_700, r.ssee_landing, r.claim_landing,
                       r.worst_landing, r.health_coverage, r.worst_health_coverage);
  }
  const FleetResult& all = study.fleets[2].result;
  out << "\n  all, health:         ";
  print_shares(out, study.health, all.health_coverage_by_channel);
  out << "  all, outputs steady: ";
  print_shares(out, study.auxiliary, all.steady_coverage);
  out << "  all, after a slam:   ";
  print_shares(out, study.auxiliary, all.slam_coverage);
  out << fmt::format("\n  {:<66}{:>10}   {:<14}\n", "figure", "measured", "asked");
  for (const FlightFigure& f : study.figures)
    out << fmt::format("  {:<66}{:>10.3f}   {:<14}{}\n", f.what, f.measured, asked(f), f.met() ? "" : "  MISSED");
  for (const FlightFleet& f : study.fleets)
    for (const FailedEngine& e : f.result.failed)
      out << fmt::format("  engine {} of '{}' is in no figure: {}\n", e.index, f.name, e.why);
}

nlohmann::ordered_json flight_study_as_json(const FlightStudy& study) {
  nlohmann::ordered_json fleets = nlohmann::ordered_json::array(), figures = nlohmann::ordered_json::array();
  for (const FlightFleet& f : study.fleets) {
    const FleetResult& r = f.result;
    nlohmann::ordered_json failed = nlohmann::ordered_json::array();
    for (const FailedEngine& e : r.failed) failed.push_back({{"engine", e.index}, {"why", e.why}});
    fleets.push_back({{"truth", f.name},
                      {"flown", r.flown},
                      {"failed", failed},
                      {"estimated", r.estimated},
                      {"ssee_700", r.ssee_700},
                      {"claim_700", r.claim_700},
                      {"ssee_landing", r.ssee_landing},
                      {"claim_landing", r.claim_landing},
                      {"worst_landing", r.worst_landing},
                      {"steps", findings_as_json(r.steps)},
                      {"biases", findings_as_json(r.biases)},
                      {"health_coverage", r.health_coverage},
                      {"health_coverage_by_channel", r.health_coverage_by_channel},
                      {"steady_coverage", r.steady_coverage},
                      {"slam_coverage", r.slam_coverage}});
  }
  for (const FlightFigure& f : study.figures)
    figures.push_back({{"what", f.what}, {"measured", f.measured}, {"asked", asked(f)}, {"met", f.met()}});
  return {{"engines", study.fleets.front().options.engines},
          {"seed", study.fleets.front().options.draw.seed},
          {"step_s", study.fleets.front().options.step_s},
          {"health", study.health},
          {"auxiliary", study.auxiliary},
          {"fleets", fleets},
          {"figures", figures}};
}

}  // namespace ehm::tuner_design
