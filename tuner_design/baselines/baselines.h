// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a design is compared with, each on the same model, sensors, noise and Qh, from the worst information to the
// best:
//
//   design            the design itself
//   closed_form       Kalman filter on V = H Ph (on the strongest t rows of it where the design has fewer tuners)
//   best_subset       on the t health parameters that serve best by the design's own weights, all C(p, t) tried
//   published_subset  on the seven of [SG] table 3: all but fan efficiency, LPC flow and LPT efficiency; only where the
//                     model has them by name ("FAN_flow" and "fan_flow", "HPT_eff" and "hpt_efficiency" are the same)
//   named_subset      on those that the user names
//   svd               on the first t right singular vectors of [H; Hz], reporting units
//   full_map          full-order MAP on one noisy snapshot
//   gauss_markov      steady full-order filter, health driven as hard as the tuners are: rho of gauss_markov.h
//   time_varying      full-order filter after `run_s` from a cold start: the limit for that many samples, limit_after.h
//   bayes_limit       endless averaging at this point
//
// t is the design's number of tuners; where nothing is reduced (t = p) the subsets and the SVD would all be the design,
// and are left out, as is a subset that the sensors cannot tell apart. Error: squared, over the fleet, on the linear
// truth: constant h, an engine that the model's process noise moves (but full_map's and bayes_limit's: those are in
// balance), and no linearisation error, which `design` adds to the published sigma of its own filter. Steady filters
// are settled.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "monitor/design/design.h"

namespace ehm::tuner_design {

struct Baseline {
  std::string name;         ///< as above
  std::string description;  ///< one line, with the numbers and names that matter
  design::ErrorByChannel error;
  std::optional<double> slowest_time_constant_s;  ///< of what has one: the steady filters
};

struct BaselineOptions {
  std::vector<std::string> named_subset;
  double run_s = 30.0;
  unsigned threads = 1;
  std::function<void(std::size_t)> progress = [](std::size_t) {};  ///< number of subsets done
};

/// Subsets that baselines() will try: the total of its progress.
std::size_t subsets_to_try(const design::Design& design);

/// @throws std::invalid_argument if a named health parameter is unknown or appears twice, or run_s is shorter than a
///         sample or longer than a million of them; std::runtime_error if a solver fails, or if the sensors cannot tell
///         the named subset apart.
std::vector<Baseline> baselines(const design::Design& design, const BaselineOptions& options);

}  // namespace ehm::tuner_design
