// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/print/studies/endurthi_ukf_text.h"

#include <fmt/format.h>

#include <ostream>

namespace ehm::tuner_design {

void print_pendulum_study(const std::vector<endurthi::PendulumFilter>& study, std::ostream& out) {
  out << "Endurthi's pendulum on a cart, its position measured every 5 ms: root mean square errors\n";
  out << fmt::format("  {:<16}{:>16}{:>16}{:>16}{:>16}\n", "filter", "angle to 1.5 s", "from 1.5 s, rad", "y to 1.5 s",
                     "from 1.5 s, m");
  for (const endurthi::PendulumFilter& f : study)
    out << fmt::format("  {:<16}{:>16.4f}{:>16.4f}{:>16.4f}{:>16.4f}\n", f.name, f.angle_before_rad, f.angle_after_rad,
                       f.position_before_m, f.position_after_m);
  out << "The thesis: the unscented filter is better from 1.5 s on, where the pendulum has fallen through pi.\n";
}

nlohmann::ordered_json pendulum_study_as_json(const std::vector<endurthi::PendulumFilter>& study) {
  nlohmann::ordered_json filters = nlohmann::ordered_json::array();
  for (const endurthi::PendulumFilter& f : study)
    filters.push_back({{"filter", f.name},
                       {"angle_before_rad", f.angle_before_rad},
                       {"angle_after_rad", f.angle_after_rad},
                       {"position_before_m", f.position_before_m},
                       {"position_after_m", f.position_after_m}});
  return {{"split_s", endurthi::pendulum_split_s}, {"filters", filters}};
}

void print_ukf_turbofan(const std::vector<endurthi::TurbofanPoint>& study, std::ostream& out) {
  out << "Health by filters on the nonlinear engine itself over flights of 3 s (the thesis planned it: 472 hours)\n";
  for (const endurthi::TurbofanPoint& point : study) {
    out << fmt::format("\n{}: root mean square error at the flights' ends, percent of nominal\n  {:<16}", point.name,
                       "parameter");
    for (const auto& f : point.filters) out << fmt::format("{:>12}", f.name);
    out << '\n';
    for (std::size_t i = 0; i <= point.health.size(); ++i) {
      out << fmt::format("  {:<16}", i < point.health.size() ? point.health[i] : "mean");
      for (const auto& f : point.filters) out << fmt::format("{:>12.4f}", f.errors.percent[i]);
      out << '\n';
    }
    const auto row = [&](const char* what, const char* format, const auto& value) {
      out << fmt::format("  {:<16}", what);
      for (const auto& f : point.filters) out << fmt::format(fmt::runtime(format), value(f));
      out << '\n';
    };
    row("mean, % change", "{:>12.2f}", [](const auto& f) { return f.errors.of_change.back(); });
    row("coverage", "{:>12.3f}", [](const auto& f) { return f.coverage; });
    row("no answer", "{:>12}", [](const auto& f) { return f.lost; });
    row("seconds", "{:>12.2f}", [](const auto& f) { return f.seconds; });
  }
}

nlohmann::ordered_json ukf_turbofan_as_json(const std::vector<endurthi::TurbofanPoint>& study) {
  nlohmann::ordered_json points = nlohmann::ordered_json::array();
  for (const endurthi::TurbofanPoint& point : study) {
    nlohmann::ordered_json filters = nlohmann::ordered_json::array();
    for (const auto& f : point.filters)
      filters.push_back({{"filter", f.name},
                         {"rms_percent", f.errors.percent},
                         {"rms_percent_of_change", f.errors.of_change},
                         {"coverage", f.coverage},
                         {"no_answer", f.lost},
                         {"seconds", f.seconds}});
    points.push_back({{"point", point.name}, {"health", point.health}, {"filters", filters}});
  }
  return {{"points", points}};
}

}  // namespace ehm::tuner_design
