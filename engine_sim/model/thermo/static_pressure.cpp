// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/thermo/static_pressure.h"

#include <cmath>

#include "engine_sim/model/thermo/gas.h"

namespace ehm::engine_sim {

std::optional<SubsonicState> subsonic_state(const Station& total, double area_m2) noexcept {
  const double f = total.fuel_air_ratio, r = gas_constant_j_kgk(f);
  const double h_total = enthalpy_property(total.tt_k, f).value;
  const double phi_total = entropy_property(total.tt_k, f).value;
  const double flux = total.w_kg_s / area_m2;
  double v_m_s = flux * r * total.tt_k / total.pt_pa, t = total.tt_k;
  for (int i = 0; i < 50; ++i) {
    const GasTemperature inner = temperature_from_enthalpy(h_total - 0.5 * v_m_s * v_m_s, f, t);
    t = inner.t_k;
    const double p = total.pt_pa * std::exp((entropy_property(t, f).value - phi_total) / r);
    const double cp = 1.0 / inner.by_target;
    const double mach_squared = v_m_s * v_m_s / (cp / (cp - r) * r * t);
    if (mach_squared >= 1.0) return std::nullopt;
    // d(rho V)/dV = rho (1 - M^2): Newton from below, monotone up to M = 1
    const double density = p / (r * t);
    const double step = (flux / density - v_m_s) / (1.0 - mach_squared);
    // the last step by dp = -rho V dV: the error left is of the order of its square
    if (std::abs(step) < 1e-7 * v_m_s) return SubsonicState{p - density * v_m_s * step, t, v_m_s + step, mach_squared};
    v_m_s += step;
  }
  return std::nullopt;
}

StaticPressureSlopes static_pressure_slopes(const Station& total, const SubsonicState& at) noexcept {
  const double f = total.fuel_air_ratio, r = gas_constant_j_kgk(f);
  const GasProperty h_total = enthalpy_property(total.tt_k, f), phi_total = entropy_property(total.tt_k, f);
  const GasProperty h = enthalpy_property(at.t_k, f), phi = entropy_property(at.t_k, f);
  const double h_f = h_total.by_fuel_air_ratio - h.by_fuel_air_ratio;
  const double phi_f = phi.by_fuel_air_ratio - phi_total.by_fuel_air_ratio;
  const double v = at.v_m_s, cp = h.by_temperature;
  // dV = V/(1 - M^2) (dW/W - dPt/Pt - (1 - R/cp)/(R T) (cpt dTt + h_f df) + phi_t dTt/R - phi_f df/R)
  const double v_by_log_flow = v / (1.0 - at.mach_squared), by_heat = (1.0 - r / cp) / (r * at.t_k);
  const double v_by_tt = v_by_log_flow * (phi_total.by_temperature / r - by_heat * h_total.by_temperature);
  const double v_by_f = -v_by_log_flow * (by_heat * h_f + phi_f / r);
  // dp = p (dPt/Pt + (cpt dTt + h_f df - V dV)/(R T) - phi_t dTt/R + phi_f df/R),  phi_t at the total temperature
  const double by_v = -at.p_pa * v / (r * at.t_k);
  return {by_v * v_by_log_flow / total.w_kg_s, at.p_pa / total.pt_pa - by_v * v_by_log_flow / total.pt_pa,
          at.p_pa * (h_total.by_temperature / (r * at.t_k) - phi_total.by_temperature / r) + by_v * v_by_tt,
          at.p_pa * (h_f / (r * at.t_k) + phi_f / r) + by_v * v_by_f};
}

double area_at_mach_m2(const Station& total, double mach) {
  const double f = total.fuel_air_ratio, r = gas_constant_j_kgk(f);
  const double h_total = enthalpy_property(total.tt_k, f).value;
  double t = total.tt_k;
  for (int i = 0; i < 50; ++i) {
    // h(T) = ht - M^2 gamma R T/2; the right hand side moves by less than M^2/5 of T
    const double cp = specific_heat_j_kgk(t, f), gamma = cp / (cp - r);
    const double next = temperature_from_enthalpy(h_total - 0.5 * mach * mach * gamma * r * t, f, t).t_k;
    if (std::abs(next - t) < 1e-12 * t) break;
    t = next;
  }
  const double v_m_s = std::sqrt(2.0 * (h_total - enthalpy_property(t, f).value));
  const double phi_difference = entropy_property(t, f).value - entropy_property(total.tt_k, f).value;
  const double p_pa = total.pt_pa * std::exp(phi_difference / r);
  return total.w_kg_s * r * t / (p_pa * v_m_s);
}

}  // namespace ehm::engine_sim
