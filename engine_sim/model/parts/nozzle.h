// SPDX-License-Identifier: Apache-2.0
#pragma once
// Convergent nozzle, choked or not, with real-gas isentropic expansion to the throat:
//   unchoked: p = p_ambient;  choked: V^2 = gamma R T at the throat, p = p_critical > p_ambient
//   phi(T) = phi(Tt) - R ln(Pt/p);  V = sqrt(2 (ht - h(T)));  flow capacity = A V p/(R T)
//   gross thrust = W Cv V + (p - p_ambient) A
// Flow and thrust are continuously differentiable where choking sets in. Below Pt/p_ambient = 1.0005 the flow continues
// along a straight line in ln(Pt/p_ambient) through the wall of the square root, for the solver's sake only.
// Units: Pa, K, m2, m/s, kg/s, N. Errors: none here; turbofan.cpp refuses a solution with Pt <= p_ambient.
// Source: Walsh & Fletcher, chapter 5 (propelling nozzles), Q curves of chapter 3 with variable cp.

#include <type_traits>

#include "engine_sim/model/engine_data.h"
#include "engine_sim/model/thermo/stream.h"

namespace ehm::engine_sim {

template <class S>
struct NozzleFlow {
  S flow_capacity_kg_s;
  S gross_thrust_n;
  bool choked;
};

/// Static temperature at which gas of the total temperature tt_k and enthalpy h(tt_k) reaches the speed of sound:
/// 2 (ht - h(T)) = gamma(T) R T.
double sonic_temperature_k(double tt_k, double total_h_j_kg, double fuel_air_ratio);
/// The same with its partial derivatives by the total enthalpy and the fuel-air ratio.
GasTemperature sonic_temperature(double tt_k, double total_h_j_kg, double fuel_air_ratio);

/// At the throat of a choked nozzle flow and impulse are stationary along the isentrope, so the sonic temperature may
/// be held while they are differentiated: the flow's derivative is exact, the thrust's but for the factor Cv, which is
/// enough for Newton's method. With derivatives by parameters (P a dual number) it carries its own.
template <class P, class S>
S throat_temperature_k(const Stream<S>& in) {
  const double tt_k = value(in.tt_k), h_j_kg = value(in.h_j_kg), f = value(in.fuel_air_ratio);
  if constexpr (std::is_same_v<P, double>) {
    return S(sonic_temperature_k(tt_k, h_j_kg, f));
  } else {
    const GasTemperature t = sonic_temperature(tt_k, h_j_kg, f);
    return chain(t.t_k, t.by_target, in.h_j_kg, t.by_fuel_air_ratio, in.fuel_air_ratio);
  }
}

/// The jet when it expands to the static temperature t_k.
template <class S, class P>
NozzleFlow<S> jet(const NozzleData& data, const Stream<S>& in, const S& t_k, const S& log_pressure_ratio,
                  double ambient_p_pa, const P& area_ratio) {
  using std::exp, std::sqrt;
  const S p_pa = in.pt_pa * exp(-log_pressure_ratio);
  const S velocity_m_s = sqrt(2.0 * (in.h_j_kg - enthalpy(t_k, in.fuel_air_ratio)));
  const P area_m2 = data.area_m2 * area_ratio;
  const S flow = area_m2 * velocity_m_s * p_pa / (gas_constant<P>(in.fuel_air_ratio) * t_k);
  const S thrust = in.w_kg_s * data.velocity_coefficient * velocity_m_s + (p_pa - ambient_p_pa) * area_m2;
  return {flow, thrust, false};
}

/// `area_ratio`: of a variable nozzle, to the nominal area.
template <class S, class P = double>
NozzleFlow<S> exhaust(const NozzleData& data, const Stream<S>& in, double ambient_p_pa, const P& area_ratio = 1.0) {
  using std::log;
  constexpr double lowest_log_ratio = 5e-4;
  const auto r = gas_constant<P>(in.fuel_air_ratio);
  const S log_available = log(in.pt_pa / ambient_p_pa);

  const S t_sonic = throat_temperature_k<P>(in);
  const S log_critical =
      (entropy_function(in.tt_k, in.fuel_air_ratio) - entropy_function(t_sonic, in.fuel_air_ratio)) / r;
  if (value(log_available) >= value(log_critical)) {
    NozzleFlow<S> choked = jet(data, in, t_sonic, log_critical, ambient_p_pa, area_ratio);
    choked.choked = true;
    return choked;
  }
  const bool stalled = value(log_available) < lowest_log_ratio;
  const S log_ratio = stalled ? S(lowest_log_ratio) : log_available;
  NozzleFlow<S> out = jet(data, in, isentropic_temperature<P>(in.tt_k, in.fuel_air_ratio, S(-log_ratio)), log_ratio,
                          ambient_p_pa, area_ratio);
  // flow ~ sqrt(log ratio) close to zero: its tangent continues it
  if (stalled) {
    out.flow_capacity_kg_s =
        out.flow_capacity_kg_s * (1.0 + (log_available - lowest_log_ratio) / (2.0 * lowest_log_ratio));
  }
  return out;
}

}  // namespace ehm::engine_sim
