#pragma once
// Linear point model of the nonlinear turbofan at a steady operating point, by central differences of the shaft
// accelerations xdot = [n1_dot, n2_dot] and of the outputs at t = 0 (Endurthi thesis ch. 4, perturbation method):
//   df/dv = ( f(v + s) - f(v - s) ) / 2 s       v each of x = [N1 N2] rpm, u = Wf kg/s, ten health fractions
// A in 1/s, B rpm/s per kg/s, L rpm/s per fraction; sensors Nf Nc (rpm) P24 Ps30 (Pa) T24 T30 T48 (K); auxiliary T40
// T50 (K), Fn (N), SmLPC (percent). The step is relative to trim for x and u, absolute for health, one for all columns:
// the truncation error falls with s^2, the round-off error of the flow balance grows with 1/s, and the step study takes
// the s between whose neighbours the scaled derivatives change least.
// The engine is not linear over the fleet's spread of health: `fleet` engines with h ~ N(0, health_sigma) run at the
// trim's fan speed, and the second moment of [y; z] - linear([y; z]) over them becomes the model's linearisation_error.

#include <cstdint>
#include <vector>

#include "engine_sim/model/steady.h"
#include "engine_sim/model/turbofan.h"
#include "monitor/estimation/linear_model.h"

namespace ehm::bench {

/// Noise and spread that go into the model ([SG] table 2 for the sensors).
struct NoiseAssumptions {
  double speed_percent = 0.25;
  double pressure_percent = 0.5;
  double temperature_percent = 0.75;
  double health_sigma = 0.02;           ///< fraction
  double process_noise_percent = 0.01;  ///< of the speeds' trim, per sample
};

struct LineariseOptions {
  engine::FlightCondition flight;
  engine::HealthVector health{};
  engine::Demand demand;
  double sample_time_s = 0.015;
  NoiseAssumptions noise;
  int fleet = 500;         ///< engines that measure the linearisation error; 0: not measured
  std::uint64_t seed = 1;  ///< of that fleet
};

/// One step of the study.
struct StepStudyRow {
  double step = 0.0;
  double change = 0.0;  ///< largest relative change of a scaled column to the next smaller step
};

struct Linearisation {
  estimation::LinearModel model;  ///< continuous
  double step = 0.0;              ///< that was chosen
  std::vector<StepStudyRow> study;
};

/// @throws what solve_steady throws if there is no steady point.
/// @throws std::runtime_error if more than one engine of the fleet in a hundred has no steady point.
/// @throws std::runtime_error if no step gives derivatives that agree to 1e-3 with its neighbour's.
Linearisation linearise(const engine::Turbofan& turbofan, const LineariseOptions& options);

}  // namespace ehm::bench
