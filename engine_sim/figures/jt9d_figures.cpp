#include "engine_sim/figures/jt9d_figures.h"

#include <cmath>

#include "engine_sim/engines/jt9d.h"
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
const TurbineView hpt_view{"hpt", "High-pressure turbine", {60, 70, 80, 90, 100, 110}, 3.0, 8.0};
const TurbineView lpt_view{"lpt", "Low-pressure turbine", {60, 70, 80, 90, 100, 110, 120}, 3.0, 8.0};

}  // namespace

std::vector<Figure> jt9d_figures(const std::optional<files::CsvTable>& reference) {
  const Turbofan turbofan(jt9d());
  const EngineData& e = turbofan.data();
  const std::vector<OperatingLine> lines = operating_lines(turbofan);
  const auto points = [&](const char* component) {
    return reference ? reference_points(*reference, component) : std::vector<ReferencePoint>{};
  };
  // ducts keep the temperature: 21 is the LPC's inlet, 24 the HPC's
  return {compressor_figure(
              fan_view, e.fan, lines,
              [&e](const SteadyPoint& p) -> CompressorPlace {
                return {corrected_speed(e.fan, p.gas.speeds.n1_rpm, p.gas.s2), p.unknowns.r_line_fan};
              },
              points("Fan")),
          compressor_figure(
              lpc_view, e.lpc, lines,
              [&e](const SteadyPoint& p) -> CompressorPlace {
                return {corrected_speed(e.lpc, p.gas.speeds.n1_rpm, p.gas.s21), p.unknowns.r_line_lpc};
              },
              points("LPC")),
          compressor_figure(
              hpc_view, e.hpc, lines,
              [&e](const SteadyPoint& p) -> CompressorPlace {
                return {corrected_speed(e.hpc, p.gas.speeds.n2_rpm, p.gas.s24), p.unknowns.r_line_hpc};
              },
              points("HPC")),
          turbine_figure(
              hpt_view, e.hpt, lines,
              [&e](const SteadyPoint& p) -> TurbinePlace {
                return {speed_percent(e.hpt, p.gas.speeds.n2_rpm, p.gas.s40), p.unknowns.pressure_ratio_hpt};
              },
              points("HPT")),
          turbine_figure(
              lpt_view, e.lpt, lines,
              [&e](const SteadyPoint& p) -> TurbinePlace {
                return {speed_percent(e.lpt, p.gas.speeds.n1_rpm, p.gas.s48), p.unknowns.pressure_ratio_lpt};
              },
              points("LPT"))};
}

}  // namespace ehm::engine_sim
