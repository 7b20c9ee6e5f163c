// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/print/envelope_text.h"

#include <fmt/format.h>

#include <ostream>

namespace ehm::tuner_design {
namespace {

const char* name_of(const schedule::Axis& axis) {
  return schedule::variable_names[static_cast<std::size_t>(axis.variable)];
}

std::vector<std::string> output_names(const design::Design& design) {
  std::vector<std::string> names;
  for (const auto& c : design.model.sensors) names.push_back(c.name);
  for (const auto& c : design.model.auxiliary) names.push_back(c.name);
  return names;
}

}  // namespace

void print_envelope(const EnvelopeResult& result, const design::Design& design, std::ostream& out) {
  out << fmt::format("Schedule of {} points, {} valid, {} of them unstable; the tuner filter watches at: {}\n",
                     result.schedule.nodes.size(), result.valid, result.unstable, design.model.name);
  for (const schedule::Axis& axis : result.schedule.axes) {
    out << fmt::format("  {:<17}", name_of(axis));
    for (const double x : axis.points) out << fmt::format(" {:.4g}", x);
    out << '\n';
  }
  if (result.error.places == 0) return;
  out << fmt::format("  what interpolation misses of the engine at {} of {} random places, percent of the reading:\n",
                     result.error.answered, result.error.places);
  const auto names = output_names(design);
  for (std::size_t i = 0; i < names.size(); ++i)
    out << fmt::format("    {:<10} rms {:6.3f}  most {:7.3f}\n", names[i], result.error.rms_percent[i],
                       result.error.most_percent[i]);
}

nlohmann::ordered_json envelope_as_json(const EnvelopeResult& result, const design::Design& design) {
  nlohmann::ordered_json axes = nlohmann::ordered_json::array(), errors = nlohmann::ordered_json::array();
  for (const schedule::Axis& axis : result.schedule.axes)
    axes.push_back({{"variable", name_of(axis)}, {"points", axis.points}});
  const auto names = output_names(design);
  for (std::size_t i = 0; i < result.error.rms_percent.size(); ++i)
    errors.push_back({{"output", names[i]},
                      {"rms_percent", result.error.rms_percent[i]},
                      {"most_percent", result.error.most_percent[i]}});
  return {{"nodes", result.schedule.nodes.size()}, {"valid", result.valid},
          {"unstable", result.unstable},           {"axes", std::move(axes)},
          {"interpolation", std::move(errors)},    {"hash", design.hash}};
}

}  // namespace ehm::tuner_design
