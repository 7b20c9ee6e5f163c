// SPDX-License-Identifier: Apache-2.0
#pragma once
// Kosanam's chapter VI: a gain found by an evolutionary search on the simulated error, against the Kalman gain and the
// robust one, on a vehicle that moves along a straight line:
//   [s; v]+ = [1 T; 0 1] [s; v] + [T^2/2; T] (a + w),   y = s + v_y,   estimate by a steady gain K, 2 x 1
// a known. Noise uncertain: a run's variances are (1 + alpha) and (1 + beta) times the model's, alpha, beta ~ N(0,
// spread^2), at least a tenth is left. Model uncertain: the vehicle answers with (1 + gamma) a, gamma ~ N(0,
// answer_spread^2). Error: root mean square of position over runs and samples, ft, on runs that the search has not
// seen.
//
// *Readings*: the thesis gives no numbers. T 0.1 s, noise of position 10 ft, of acceleration 0.2 ft/s^2, a = 1 ft/s^2
// are the vehicle of D. Simon, "Kalman Filtering", Embedded Systems Programming, June 2001; its genetic algorithm (rank
// selection, 50 % elitism, uniform mutation) is NLopt's GN_ESCH here (da Silva Santos et al. 2010): we own none.
// Deterministic: same seed, same bytes. Errors: none.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace ehm::tuner_design {

struct GainSearchOptions {
  double spread = 3.0, answer_spread = 0.1;
  int training_runs = 50, test_runs = 200, samples = 600, evaluations = 1000;
  std::uint64_t seed = 1;
};

struct SearchedGain {
  std::string name;
  Eigen::Vector2d K;
  double error_ft = 0.0;  ///< on the test runs
};

/// One kind of uncertainty: Kalman, robust, searched.
struct GainSearchRow {
  std::string uncertainty;
  std::array<SearchedGain, 3> gains;
  double published_robust = 0.0,
         published_searched = 0.0;  ///< share of the Kalman filter's error that it saved; 0: none

  double saved(std::size_t gain) const { return 1.0 - gains[gain].error_ft / gains[0].error_ft; }
};

struct GainSearch {
  GainSearchOptions options;
  std::vector<GainSearchRow> rows;  ///< noise, model
};

GainSearch search_gains(const GainSearchOptions& options);

}  // namespace ehm::tuner_design
