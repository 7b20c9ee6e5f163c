// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/engines/channel_table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/model/units.h"

namespace ehm::engine_sim {
namespace {

template <Station GasPath::*station, double Station::*value>
double at(const GasPath& g, const Ratings&) {
  return (g.*station).*value;
}

template <double GasPath::*value>
double of(const GasPath& g, const Ratings&) {
  return g.*value;
}

template <double SpoolSpeeds::*speed>
double rpm(const GasPath& g, const Ratings&) {
  return g.speeds.*speed;
}

template <double SpoolSpeeds::*speed>
double corrected_rpm(const GasPath& g, const Ratings&) {
  return g.speeds.*speed / std::sqrt(g.s2.tt_k / reference_temperature_k);
}

template <Metal lump>
double metal(const GasPath& g, const Ratings&) {
  return g.metal_k[lump];
}

double egt_margin(const GasPath& g, const Ratings& ratings) {
  return ratings.t48_max_k - g.s48.tt_k;
}

using G = GasPath;
using S = Station;
using N = SpoolSpeeds;

constexpr OutputChannel outputs[] = {
    {"W2", "kg/s", "w_2_kg_s", "flow at the fan face", at<&G::s2, &S::w_kg_s>},
    {"P2", "Pa", "pt_2_pa", "total pressure at the fan face", at<&G::s2, &S::pt_pa>},
    {"T2", "K", "tt_2_k", "total temperature at the fan face", at<&G::s2, &S::tt_k>},
    {"W13", "kg/s", "w_13_kg_s", "flow at the bypass exit of the fan", at<&G::s13, &S::w_kg_s>},
    {"P13", "Pa", "pt_13_pa", "total pressure at the bypass exit of the fan", at<&G::s13, &S::pt_pa>},
    {"T13", "K", "tt_13_k", "total temperature at the bypass exit of the fan", at<&G::s13, &S::tt_k>},
    {"W21", "kg/s", "w_21_kg_s", "flow at the core exit of the fan", at<&G::s21, &S::w_kg_s>},
    {"P21", "Pa", "pt_21_pa", "total pressure at the core exit of the fan", at<&G::s21, &S::pt_pa>},
    {"T21", "K", "tt_21_k", "total temperature at the core exit of the fan", at<&G::s21, &S::tt_k>},
    {"W24", "kg/s", "w_24_kg_s", "flow at the LPC exit", at<&G::s24, &S::w_kg_s>},
    {"P24", "Pa", "pt_24_pa", "total pressure at the LPC exit", at<&G::s24, &S::pt_pa>},
    {"T24", "K", "tt_24_k", "total temperature at the LPC exit", at<&G::s24, &S::tt_k>},
    {"W30", "kg/s", "w_30_kg_s", "flow at the HPC exit", at<&G::s30, &S::w_kg_s>},
    {"P30", "Pa", "pt_30_pa", "total pressure at the HPC exit", at<&G::s30, &S::pt_pa>},
    {"T30", "K", "tt_30_k", "total temperature at the HPC exit", at<&G::s30, &S::tt_k>},
    {"W40", "kg/s", "w_40_kg_s", "flow at the burner exit", at<&G::s40, &S::w_kg_s>},
    {"P40", "Pa", "pt_40_pa", "total pressure at the burner exit", at<&G::s40, &S::pt_pa>},
    {"T40", "K", "tt_40_k", "total temperature at the burner exit", at<&G::s40, &S::tt_k>},
    {"W48", "kg/s", "w_48_kg_s", "flow behind the HPT", at<&G::s48, &S::w_kg_s>},
    {"P48", "Pa", "pt_48_pa", "total pressure behind the HPT", at<&G::s48, &S::pt_pa>},
    {"T48", "K", "tt_48_k", "total temperature behind the HPT, the exhaust gas temperature", at<&G::s48, &S::tt_k>},
    {"W50", "kg/s", "w_50_kg_s", "flow at the LPT exit", at<&G::s50, &S::w_kg_s>},
    {"P50", "Pa", "pt_50_pa", "total pressure at the LPT exit", at<&G::s50, &S::pt_pa>},
    {"T50", "K", "tt_50_k", "total temperature at the LPT exit", at<&G::s50, &S::tt_k>},
    {"Ps30", "Pa", "ps_30_pa", "static pressure at the HPC exit", of<&G::ps_30_pa>},
    {"Nf", "rpm", "n1_rpm", "fan speed, N1", rpm<&N::n1_rpm>},
    {"Nc", "rpm", "n2_rpm", "core speed, N2", rpm<&N::n2_rpm>},
    {"Wf", "kg/s", "fuel_flow_kg_s", "fuel flow", of<&G::fuel_flow_kg_s>},
    {"Fn", "N", "net_thrust_n", "net thrust", of<&G::net_thrust_n>},
    {"BPR", "ratio", "bypass_ratio", "bypass ratio, W13/W21", of<&G::bypass_ratio>},
    {"OPR", "ratio", "overall_pressure_ratio", "overall pressure ratio, P30/P2", of<&G::overall_pressure_ratio>},
    {"SmFan", "percent", "stall_margin_fan", "stall margin of the fan", of<&G::stall_margin_fan_percent>},
    {"SmLPC", "percent", "stall_margin_lpc", "stall margin of the LPC", of<&G::stall_margin_lpc_percent>},
    {"SmHPC", "percent", "stall_margin_hpc", "stall margin of the HPC", of<&G::stall_margin_hpc_percent>},
    {"Fg", "N", "gross_thrust_n", "gross thrust", of<&G::gross_thrust_n>},
    {"EGTM", "K", "egt_margin_k", "EGT margin, the rating's largest T48 minus T48", egt_margin},
    {"NfR", "rpm", "n1_corrected_rpm", "corrected fan speed, N1/sqrt(theta2)", corrected_rpm<&N::n1_rpm>},
    {"NcR", "rpm", "n2_corrected_rpm", "corrected core speed, N2/sqrt(theta2)", corrected_rpm<&N::n2_rpm>},
    {"Tm_hpc", "K", "", "metal temperature behind the HPC (without heat soak T30)", metal<hpc_metal>},
    {"Tm_hpt", "K", "", "metal temperature behind the HPT (without heat soak T48)", metal<hpt_metal>},
    {"Tm_lpt", "K", "", "metal temperature behind the LPT (without heat soak T50)", metal<lpt_metal>},
};

constexpr ControlChannel controls[] = {
    {"fuel_flow", "kg/s", "fuel_flow_kg_s", "fuel flow", 1e-3, 100.0, 0.0,
     [](Operation& o) -> double& { return o.fuel_flow_kg_s; }},
    {"VSV", "deg", "vsv_deg", "HPC stator vanes off their schedule, positive closes", -20.0, 40.0, 10.0,
     [](Operation& o) -> double& { return o.geometry.vsv_deg; }},
    {"VBV", "fraction", "vbv_fraction", "bleed valves behind the LPC, of its exit flow", 0.0, 0.5, 0.1,
     [](Operation& o) -> double& { return o.geometry.vbv_fraction; }},
    {"A8", "ratio", "core_nozzle_area_ratio", "area of the core nozzle to its nominal one", 0.5, 2.0, 1.0,
     [](Operation& o) -> double& { return o.geometry.core_nozzle_area_ratio; }},
    {"customer_bleed", "kg/s", "customer_bleed_kg_s", "air that the aircraft takes from the HPC", 0.0, 100.0, 1.0,
     [](Operation& o) -> double& { return o.offtake.customer_bleed_kg_s; }},
    {"power_offtake", "W", "power_offtake_w", "power that the aircraft takes from the HP shaft", 0.0, 1e7, 1e5,
     [](Operation& o) -> double& { return o.offtake.power_w; }},
};

template <class Channel>
const Channel* find(std::span<const Channel> channels, std::string_view name) {
  const auto found = std::find_if(channels.begin(), channels.end(), [&](const Channel& c) { return c.name == name; });
  return found == channels.end() ? nullptr : &*found;
}

template <class Channels, class Name>
std::string listed(const Channels& channels, Name name) {
  std::string text;
  for (const auto& channel : channels) text += (text.empty() ? "" : ", ") + std::string(name(channel));
  return text;
}

}  // namespace

std::span<const OutputChannel> output_channels() {
  return outputs;
}

std::span<const ControlChannel> control_channels() {
  return controls;
}

const OutputChannel* find_output(std::string_view name) {
  return find(output_channels(), name);
}

const ControlChannel* find_control(std::string_view name) {
  return find(control_channels(), name);
}

std::size_t find_health(std::string_view name) {
  return as_size(std::find(health_names.begin(), health_names.end(), name) - health_names.begin());
}

std::string output_names() {
  return listed(outputs, [](const OutputChannel& c) { return c.name; });
}

std::string control_names() {
  return listed(controls, [](const ControlChannel& c) { return c.name; });
}

std::string health_parameter_names() {
  return listed(health_names, [](std::string_view name) { return name; });
}

}  // namespace ehm::engine_sim
