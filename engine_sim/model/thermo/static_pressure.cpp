#include "engine_sim/model/thermo/static_pressure.h"

#include <cmath>
#include <string>

#include "engine_sim/model/solve/newton.h"
#include "engine_sim/model/thermo/gas.h"

namespace ehm::engine_sim {

double static_pressure_pa(const Station& total, double area_m2) {
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
    if (mach_squared >= 1.0) break;
    // d(rho V)/dV = rho (1 - M^2): Newton from below, monotone up to M = 1
    const double density = p / (r * t);
    const double step = (flux / density - v_m_s) / (1.0 - mach_squared);
    // the last step by dp = -rho V dV: the error left is of the order of its square
    if (std::abs(step) < 1e-7 * v_m_s) return p - density * v_m_s * step;
    v_m_s += step;
  }
  throw SolveError("residual 'static pressure': a flow of " + std::to_string(total.w_kg_s) +
                   " kg/s chokes the area of " + std::to_string(area_m2) + " m2");
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
