// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/engines/jt9d_engine.h"

#include "engine_sim/engines/jt9d.h"
#include "engine_sim/engines/jt9d_control.h"

namespace ehm::engine_sim {
namespace {

/// The seven sensors and four unmeasured outputs of the cruise studies. Noise: [SG] table 2 by kind of sensor; spread of
/// health over the fleet: 2 %, their assumption.
NamedChannels channels() {
  constexpr double speed_noise_percent = 0.25, pressure_noise_percent = 0.5, temperature_noise_percent = 0.75;
  constexpr double health_sigma = 0.02;
  NamedChannels channels{{{find_output("Nf"), speed_noise_percent},
                          {find_output("Nc"), speed_noise_percent},
                          {find_output("P24"), pressure_noise_percent},
                          {find_output("T24"), temperature_noise_percent},
                          {find_output("Ps30"), pressure_noise_percent},
                          {find_output("T30"), temperature_noise_percent},
                          {find_output("T48"), temperature_noise_percent}},
                         {find_output("T40"), find_output("T50"), find_output("Fn"), find_output("SmLPC")},
                         {find_control("fuel_flow"), find_control("VSV"), find_control("VBV"),
                          find_control("customer_bleed"), find_control("power_offtake")},
                         {}};
  for (std::size_t i = 0; i < health_count; ++i) channels.health.push_back({static_cast<Health>(i), health_sigma});
  return channels;
}

}  // namespace

const EngineDefinition& jt9d_engine() {
  static const EngineDefinition engine{
      "public JT9D model of nasa/T-MATS (JT9D.mdl, Apache-2.0); what that leaves open: engine_sim/engines/jt9d.cpp and "
      "jt9d_control.cpp, number by number",
      jt9d(), jt9d_control(), channels()};
  return engine;
}

std::shared_ptr<const EngineDefinition> default_engine() {
  return {std::shared_ptr<const void>(), &jt9d_engine()};  // lives as long as the program
}

}  // namespace ehm::engine_sim
