// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/print/studies/robust_study_text.h"

#include <fmt/format.h>

#include <ostream>

namespace ehm::tuner_design {

void print_robust_study(const RobustStudy& s, std::ostream& out) {
  const RobustStudyOptions& o = s.options;
  out << fmt::format(
      "Robust gain on {}: {} tuners, Qh {:g} percent^2 a sample\n"
      "One factor mu = {:.4g} on all sensors' noise: it costs {:g} % where nothing is wrong, and is the optimum of\n"
      "J = rho1 (V1 + V2) + rho2 s2^2 V2^2 for rho2 s2^2/rho1 = {:.4g} per percent^2\n\n",
      s.model, s.tuners, o.qh_percent2, s.mu, 100.0 * o.nominal_loss, s.rho2_s2);
  out << fmt::format("  {:<18}{:>24}{:>10}{:>24}{:>10}\n", "rms error, percent", "as modelled: standard", "robust",
                     fmt::format("variance x {:g}: standard", o.noise_factor), "robust");
  const auto line = [&](const std::string& name, std::size_t i) {
    out << fmt::format("  {:<18}{:>24.4f}{:>10.4f}{:>24.4f}{:>10.4f}\n", name, s.standard[i], s.robust[i],
                       s.standard_wrong[i], s.robust_wrong[i]);
  };
  for (std::size_t i = 0; i < s.health.size(); ++i) line(s.health[i], i);
  line("mean", s.health.size());
  out << fmt::format(
      "\n  robust over standard: {:.3f} as modelled (Kosanam, table 5.3: {:.3f}), {:.3f} with wrong noise (table 5.2: "
      "{:.3f})\n",
      s.nominal_ratio(), published_nominal_ratio, s.wrong_ratio(), published_wrong_ratio);
  out << fmt::format(
      "\n  one sensor's variance x {:g}, mean error: all doubted alike, or that one alone, at the same price\n"
      "  {:<18}{:>10}{:>10}{:>10}{:>22}\n",
      o.noise_factor, "sensor", "standard", "alike", "alone", "alone over alike");
  for (const DoubtedSensor& d : s.by_sensor)
    out << fmt::format("  {:<18}{:>10.4f}{:>10.4f}{:>10.4f}{:>22.3f}\n", d.sensor, d.standard, d.common, d.own,
                       d.own / d.common);
}

nlohmann::ordered_json robust_study_as_json(const RobustStudy& s) {
  nlohmann::ordered_json sensors = nlohmann::ordered_json::array(), trade = nlohmann::ordered_json::array();
  for (const DoubtedSensor& d : s.by_sensor)
    sensors.push_back({{"sensor", d.sensor}, {"standard", d.standard}, {"alike", d.common}, {"alone", d.own}});
  for (const RobustTrade& t : s.trade) trade.push_back({{"mu", t.mu}, {"process", t.process}, {"sensor", t.sensor}});
  return {{"model", s.model},
          {"health", s.health},
          {"tuners", s.tuners},
          {"mu", s.mu},
          {"rho2_s2", s.rho2_s2},
          {"standard", s.standard},
          {"robust", s.robust},
          {"standard_wrong_noise", s.standard_wrong},
          {"robust_wrong_noise", s.robust_wrong},
          {"nominal_ratio", s.nominal_ratio()},
          {"wrong_ratio", s.wrong_ratio()},
          {"published_nominal_ratio", published_nominal_ratio},
          {"published_wrong_ratio", published_wrong_ratio},
          {"by_sensor", std::move(sensors)},
          {"trade", std::move(trade)}};
}

}  // namespace ehm::tuner_design
