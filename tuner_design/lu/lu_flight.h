// SPDX-License-Identifier: Apache-2.0
#pragma once
// One flight of Lu's: the nonlinear engine in steps of 5 ms, its health h(t) + w, and a filter on its samples at 50 Hz.
//   fault      h = 0 until 1 s, then the fault; 10 s; judged over samples 401 to 500
//   gradual    h in 21 equal steps to the most wear, 10 s each; judged over the last 2 s of each
//   w          white, of a new value each sample, sigma .05 % on every parameter: Gaussian, Rayleigh moved to mean 0, or
//              as it comes (noise_distribution.h); it acts on the truth and is no part of what is to be estimated (a reading: studies.md)
// The figures of merit are the mean error and the standard deviation of the estimate over the samples judged, and SME,
// the sum of |mean error| over the parameters. Units: percent; time in s.
// Errors: none; where the filter had no answer for half a second, or an estimate is off by more than 15 %, it diverged.

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "deploy/runtime/numbers/noise_distribution.h"
#include "tuner_design/lu/lu_engine.h"

namespace ehm::tuner_design {

enum class LuFilter { extended, unscented, particle, extended_particle, boxed_particle };
inline constexpr std::array<std::string_view, 5> lu_filter_names{"EKF", "UKF", "PF", "EKPF", "cEKPF"};

struct LuFlight {
  LuFilter filter = LuFilter::extended;
  int fault = 1;  ///< 1, 2; 0: gradual wear
  NoiseDistribution noise = NoiseDistribution::gaussian;
  Eigen::Index particles = 50;
  bool own_jacobian = false, ratio_weights = false;
  std::optional<std::size_t> missing_sensor = {};
  std::uint64_t seed = 1, run = 0;
};

struct LuScore {
  LuHealth mean = LuHealth::Zero(), sigma = LuHealth::Zero();  ///< of gradual wear: at its end
  double sme = 0.0;                                            ///< of gradual wear: summed over the 21 points
  bool diverged = false;
  double filter_s_per_s = 0.0;      ///< what the filter took of a second of data: of the clock, no part of the result
  std::vector<LuHealth> estimates;  ///< at every sample
};

inline constexpr int lu_samples_a_point = 500, lu_gradual_points = 21;

/// Health without its noise at a sample of the whole flight, percent; `fault` as in LuFlight.
LuHealth lu_truth(int fault, int sample);

LuScore fly_lu(const LuEngine& engine, const LuFlight& flight);

}  // namespace ehm::tuner_design
