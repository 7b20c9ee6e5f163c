// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/print/studies/mission_fault_text.h"

#include <fmt/format.h>

#include <cmath>
#include <ostream>

#include "tuner_design/faults/false_alarm_study.h"
#include "tuner_design/faults/fault_study.h"

namespace ehm::tuner_design {
namespace {

/// A figure of the issue: a share, and what is asked of it.
struct Figure {
  std::string what;
  Share share;
  double asked = 0.0;
  bool at_most = false;
  bool met() const { return at_most ? share.value() <= asked : share.value() >= asked; }
};

bool five_sigma(const MissionFaultRow& r) {
  return r.row->broken == Broken::bias && std::abs(r.row->size) == 5.0;
}

bool of_a_sensor(const MissionFaultRow& r) {
  return r.row->broken != Broken::component && r.row->broken != Broken::nothing;
}

std::vector<Figure> figures_of(const MissionFaultStudy& study) {
  std::vector<Figure> figures;
  for (const Moment moment : {Moment::steady, Moment::climbing}) {
    const MissionFaultRow five = sum_of(study, [&](const auto& r) { return five_sigma(r) && r.moment == moment; });
    const std::string where = std::string(moment_names[static_cast<std::size_t>(moment)]) + ", biases of 5 sigma: ";
    figures.push_back({where + "found within 3 s", {five.in_time, five.flown}, 0.95});
    figures.push_back({where + "right sensor", {five.right, five.flown}, 0.90});
  }
  const MissionFaultRow transient =
      sum_of(study, [](const auto& r) { return of_a_sensor(r) && r.moment == Moment::transient; });
  figures.push_back({"transient: wrong sensor", {transient.wrong_sensor, transient.flown}, 0.03, true});
  return figures;
}

/// Per million flight hours at the rates of the table: what is said of what.
struct Weighted {
  std::string broken;
  double rate = 0.0, right = 0.0, wrong_sensor = 0.0, component = 0.0, ambiguous = 0.0, silent = 0.0;
};

std::vector<Weighted> weighted(const MissionFaultStudy& study) {
  const auto& channels = study.options.engine->channels;
  std::vector<Weighted> table;
  for (const FaultRow& what : fault_table()) {
    const MissionFaultRow r = sum_of(study, [&](const auto& row) { return row.row == &what; });
    if (r.flown == 0) continue;
    const double of =
        what.per_million_hours *
        static_cast<double>(what.broken == Broken::component ? channels.health.size() : channels.sensors.size());
    const auto share = [&](std::size_t part) { return of * static_cast<double>(part) / static_cast<double>(r.flown); };
    table.push_back({what.name, of, share(r.right), share(r.wrong_sensor), share(r.component), share(r.ambiguous),
                     share(r.flown - r.right - r.wrong_sensor - r.component - r.ambiguous)});
  }
  return table;
}

void print_rows(const MissionFaultStudy& study, std::ostream& out) {
  out << fmt::format("  {:<12}{:<20}{:>6}{:>9}{:>10}{:>7}{:>13}{:>11}{:>11}{:>14}{:>16}\n", "moment", "what broke",
                     "cases", "in 3 s", "detected", "right", "other sensor", "component", "ambiguous", "to detect, s",
                     "to diagnose, s");
  for (const MissionFaultRow& r : study.rows)
    out << fmt::format("  {:<12}{:<20}{:>6}{:>9}{:>10}{:>7}{:>13}{:>11}{:>11}{:>14.2f}{:>16.2f}\n",
                       moment_names[static_cast<std::size_t>(r.moment)], r.row->name, r.flown, r.in_time, r.detected,
                       r.right, r.wrong_sensor, r.component, r.ambiguous, r.detect_s, r.diagnose_s);
}

void print_measures(const MissionFaultStudy& study, std::ostream& out) {
  out << fmt::format("\n  AIR4985, sensor faults{:>24}{:>28}{:>16}{:>18}\n", "detection rate", "isolation rate",
                     "to detect, s", "to diagnose, s");
  for (std::size_t i = 0; i < moment_names.size(); ++i) {
    const MissionFaultRow r =
        sum_of(study, [&](const auto& row) { return of_a_sensor(row) && row.moment == static_cast<Moment>(i); });
    const Share detected{r.detected, r.flown}, isolated{r.right, r.detected};
    const auto d = detected.interval(), s = isolated.interval();
    out << fmt::format("  {:<22}{:>8.3f} ({:.3f} to {:.3f}){:>10.3f} ({:.3f} to {:.3f}){:>16.2f}{:>18.2f}\n",
                       moment_names[i], detected.value(), d[0], d[1], isolated.value(), s[0], s[1], r.detect_s,
                       r.diagnose_s);
  }
}

void print_weighted(const MissionFaultStudy& study, std::ostream& out) {
  out << fmt::format(
      "\n  Said in a million flight hours, at the assumed rates of faults\n  {:<20}{:>8}{:>9}{:>14}{:>11}"
      "{:>11}{:>9}\n",
      "what broke", "faults", "right", "other sensor", "component", "ambiguous", "silent");
  Weighted sum{.broken = "all"};
  const auto line = [&](const Weighted& w) {
    out << fmt::format("  {:<20}{:>8.0f}{:>9.1f}{:>14.1f}{:>11.1f}{:>11.1f}{:>9.1f}\n", w.broken, w.rate, w.right,
                       w.wrong_sensor, w.component, w.ambiguous, w.silent);
  };
  for (const Weighted& w : weighted(study)) {
    line(w);
    sum.rate += w.rate;
    sum.right += w.right;
    sum.wrong_sensor += w.wrong_sensor;
    sum.component += w.component;
    sum.ambiguous += w.ambiguous;
    sum.silent += w.silent;
  }
  line(sum);
}

void print_fault_free(const MissionFaultStudy& study, std::ostream& out) {
  const auto alarms = poisson_interval(study.false_alarms);
  out << fmt::format("  false alarms in {:.1f} fault-free hours{:>36}{:>22}   at most 3 in 30 h{}\n",
                     study.fault_free_hours, study.false_alarms, fmt::format("{:.1f} to {:.1f}", alarms[0], alarms[1]),
                     static_cast<double>(study.false_alarms) <= 0.1 * study.fault_free_hours ? "" : "  MISSED")
      << fmt::format(
             "  the flights without faults, at {:g} s: estimates in {:.4f} of the samples, coverage of health {:.3f}, "
             "SSEE at landing {:.2f} percent^2 (claimed {:.2f})\n",
             study.sample_time_s, study.estimated, study.coverage, study.ssee_landing, study.claim_landing);
}

}  // namespace

void print_mission_fault_study(const MissionFaultStudy& study, std::ostream& out) {
  const MissionFaultOptions& o = study.options;
  out << fmt::format(
      "Fault study over whole flights: engine {}, estimator {}, everything perturbed, seed {}; {} flights of two hours "
      "with faults, {} without\n\n",
      o.engine->data.name, o.estimator, o.seed, o.flights, o.fault_free);
  print_rows(study, out);
  print_measures(study, out);
  print_weighted(study, out);
  out << fmt::format("\n  {:<58}{:>9}{:>22}   asked\n", "figure", "measured", "95 % interval");
  for (const Figure& f : figures_of(study)) {
    const auto interval = f.share.interval();
    out << fmt::format("  {:<58}{:>9.3f}{:>22}   {} {:g}{}\n", f.what, f.share.value(),
                       fmt::format("{:.3f} to {:.3f}", interval[0], interval[1]), f.at_most ? "at most" : "at least",
                       f.asked, f.met() ? "" : "  MISSED");
  }
  if (study.options.fault_free > 0) print_fault_free(study, out);
  out << fmt::format("  false alarms in the {:.1f} hours between the faults: {}\n", study.between_hours,
                     study.alarms_between);
  if (study.not_in_use > 0)
    out << fmt::format("  {} slots did not count: the sensor was still left out, or no estimate was there\n",
                       study.not_in_use);
  for (const std::string& why : study.failed) out << "  " << why << '\n';
}

nlohmann::ordered_json mission_fault_study_as_json(const MissionFaultStudy& study) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array(), figures = nlohmann::ordered_json::array(),
                         rates = nlohmann::ordered_json::array();
  for (const MissionFaultRow& r : study.rows)
    rows.push_back({{"moment", moment_names[static_cast<std::size_t>(r.moment)]},
                    {"what_broke", r.row->name},
                    {"cases", r.flown},
                    {"found_in_3_s", r.in_time},
                    {"detected", r.detected},
                    {"right", r.right},
                    {"other_sensor", r.wrong_sensor},
                    {"component", r.component},
                    {"ambiguous", r.ambiguous},
                    {"mean_time_to_detect_s", r.detect_s},
                    {"mean_time_to_diagnose_s", r.diagnose_s}});
  for (const Figure& f : figures_of(study))
    figures.push_back({{"what", f.what},
                       {"measured", f.share.value()},
                       {"interval", f.share.interval()},
                       {"asked", f.asked},
                       {"at_most", f.at_most},
                       {"met", f.met()}});
  for (const Weighted& w : weighted(study))
    rates.push_back({{"what_broke", w.broken},
                     {"faults", w.rate},
                     {"right", w.right},
                     {"other_sensor", w.wrong_sensor},
                     {"component", w.component},
                     {"ambiguous", w.ambiguous},
                     {"silent", w.silent}});
  return {{"flights", study.options.flights},
          {"fault_free_flights", study.options.fault_free},
          {"estimator", study.options.estimator},
          {"seed", study.options.seed},
          {"figures", std::move(figures)},
          {"fault_free_hours", study.fault_free_hours},
          {"false_alarms", study.false_alarms},
          {"false_alarms_interval", poisson_interval(study.false_alarms)},
          {"hours_between_faults", study.between_hours},
          {"alarms_between_faults", study.alarms_between},
          {"samples_with_estimates", study.estimated},
          {"coverage", study.coverage},
          {"ssee_landing", study.ssee_landing},
          {"claim_landing", study.claim_landing},
          {"slots_not_in_use", study.not_in_use},
          {"failed", study.failed},
          {"rows", std::move(rows)},
          {"in_a_million_flight_hours", std::move(rates)}};
}

std::string mission_fault_study_as_csv(const MissionFaultStudy& study) {
  const engine_sim::NamedChannels& channels = study.options.engine->channels;
  const auto name = [&](bool health, std::size_t i) {
    return health ? std::string(engine_sim::health_names[channels.health[i].parameter])
                  : std::string(channels.sensors[i].quantity->name);
  };
  const auto time = [](const std::optional<double>& s) { return s ? fmt::format("{:.3f}", *s) : std::string(); };
  std::string csv = "flight,onset_s,moment,what_broke,channel,said,said_channel,delay_s,named_s,size\n";
  for (std::size_t i = 0; i < study.flights.size(); ++i)
    for (const SlotOutcome& s : study.flights[i].slots) {
      const FaultOutcome& o = s.outcome;
      const bool said = o.answer != Answer::nothing;
      csv += fmt::format("{},{:g},{},{},{},{},{},{},{},{:.6g}\n", i, s.slot.onset_s,
                         moment_names[static_cast<std::size_t>(s.slot.moment)], s.slot.what.row->name,
                         name(s.slot.what.row->broken == Broken::component, s.slot.what.channel),
                         o.flown ? name_of(o.answer) : "not_in_use",
                         said ? name(o.answer == Answer::component, o.channel) : "", time(o.delay_s), time(o.named_s),
                         o.size);
    }
  return csv;
}

}  // namespace ehm::tuner_design
