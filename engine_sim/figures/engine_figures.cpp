// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/figures/engine_figures.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "engine_sim/figures/compressor_figure.h"
#include "engine_sim/figures/turbine_figure.h"
#include "engine_sim/model/units.h"

namespace ehm::engine_sim {
namespace {

double corrected_speed(const CompressorData& compressor, double n_rpm, const Station& inlet) {
  return n_rpm / (std::sqrt(inlet.tt_k / reference_temperature_k) * compressor.scale.s_nc);
}

double speed_percent(const TurbineData& turbine, double n_rpm, const Station& inlet) {
  return n_rpm / (std::sqrt(inlet.tt_k * rankine_per_kelvin) * turbine.scale.s_nc);
}

const CompressorView fan_view{"fan", "Fan", {0.5, 0.6, 0.7, 0.8, 0.85, 0.9, 0.95, 1.0, 1.05, 1.1, 1.15}, 2.6};
const CompressorView lpc_view{
    "lpc", "Low-pressure compressor", {0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.25}, 2.5};
const CompressorView hpc_view{
    "hpc", "High-pressure compressor", {0.7, 0.75, 0.8, 0.85, 0.9, 0.925, 0.95, 0.975, 1.0, 1.025, 1.05}, 2.8};
const TurbineView hpt_view{"hpt", "High-pressure turbine", {60, 70, 80, 90, 100, 110}, 0, 0};
const TurbineView lpt_view{"lpt", "Low-pressure turbine", {60, 70, 80, 90, 100, 110, 120}, 0, 0};

/// Lines beyond the map would show its continuation, not the map.
std::vector<double> within(std::vector<double> speeds, std::span<const double> breaks) {
  std::erase_if(speeds, [&](double speed) { return speed < breaks.front() || speed > breaks.back(); });
  return speeds.size() < 2 ? std::vector<double>{breaks.front(), breaks.back()} : speeds;
}

CompressorView on_map(CompressorView view, const CompressorMap& map) {
  view.speeds = within(view.speeds, map.data().speed_breaks);
  return view;
}

TurbineView on_map(TurbineView view, const TurbineMap& map) {
  view.speeds_percent = within(view.speeds_percent, map.data().speed_breaks);
  view.lowest_pressure_ratio = map.data().pressure_ratio_breaks.front();
  view.highest_pressure_ratio = map.data().pressure_ratio_breaks.back();
  return view;
}

}  // namespace

std::vector<Figure> engine_figures(const EngineData& engine, const std::optional<files::CsvTable>& reference) {
  const Turbofan turbofan(engine);
  const EngineData& e = turbofan.data();
  const std::vector<OperatingLine> lines = operating_lines(turbofan);
  const auto points = [&](const char* component) {
    return reference ? reference_points(*reference, component) : std::vector<ReferencePoint>{};
  };
  // ducts keep the temperature: 21 is the LPC's inlet, 24 the HPC's
  return {compressor_figure(
              on_map(fan_view, e.fan.map), e.fan, lines,
              [&e](const SteadyPoint& p) -> CompressorPlace {
                return {corrected_speed(e.fan, p.gas.speeds.n1_rpm, p.gas.s2), p.unknowns.r_line_fan};
              },
              points("Fan")),
          compressor_figure(
              on_map(lpc_view, e.lpc.map), e.lpc, lines,
              [&e](const SteadyPoint& p) -> CompressorPlace {
                return {corrected_speed(e.lpc, p.gas.speeds.n1_rpm, p.gas.s21), p.unknowns.r_line_lpc};
              },
              points("LPC")),
          compressor_figure(
              on_map(hpc_view, e.hpc.map), e.hpc, lines,
              [&e](const SteadyPoint& p) -> CompressorPlace {
                return {corrected_speed(e.hpc, p.gas.speeds.n2_rpm, p.gas.s24), p.unknowns.r_line_hpc};
              },
              points("HPC")),
          turbine_figure(
              on_map(hpt_view, e.hpt.map), e.hpt, lines,
              [&e](const SteadyPoint& p) -> TurbinePlace {
                return {speed_percent(e.hpt, p.gas.speeds.n2_rpm, p.gas.s40), p.unknowns.pressure_ratio_hpt};
              },
              points("HPT")),
          turbine_figure(
              on_map(lpt_view, e.lpt.map), e.lpt, lines,
              [&e](const SteadyPoint& p) -> TurbinePlace {
                return {speed_percent(e.lpt, p.gas.speeds.n1_rpm, p.gas.s48), p.unknowns.pressure_ratio_lpt};
              },
              points("LPT"))};
}

}  // namespace ehm::engine_sim
