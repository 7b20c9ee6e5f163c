// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tables 4 to 9 of Lu, Huang & Lv on an engine of ours, each over `runs` seeds where the paper has one run:
//   4  Gaussian noise, faults 1 and 2, EKF, PF and cEKPF         5  Rayleigh noise, moved to mean 0, and as it comes
//   6  gradual wear, SME summed over 21 points                   7  cost, seconds a second of data
//   8  one sensor missing, fault 1, EKPF and cEKPF               9  N = 30, 50, 100, cEKPF, faults 1 and 2
// Beside them the UKF, the EKPF without its box (the box knows the size of the fault), weights by the ratio of densities,
// and Jacobians of each particle's own. Means and standard deviations are root mean squares over the runs, SME the mean over those that did not diverge.
// Errors: none. The same options give the same numbers on any number of threads, but for the cost.

#include <functional>
#include <string>
#include <vector>

#include "tuner_design/lu/lu_flight.h"

namespace ehm::tuner_design {

struct LuOptions {
  std::shared_ptr<const engine_sim::EngineDefinition> engine;
  int table = 4;
  std::size_t runs = 10;
  Eigen::Index particles = 50;
  std::uint64_t seed = 1;
  unsigned threads = 1;
};

/// One filter in one case, over the runs.
struct LuCase {
  LuFlight flight;
  std::string what;  ///< beside the filter's name
  LuHealth mean_rms = LuHealth::Zero(), sigma_rms = LuHealth::Zero();
  double sme = 0.0, sme_spread = 0.0;  ///< mean over the runs, and standard deviation; percent
  std::size_t diverged = 0;
  double seconds = 0.0;                   ///< least of the runs
  std::vector<LuHealth> first_estimates;  ///< of run 0: the paper's figures
};

struct LuStudy {
  LuOptions options;
  double fuel_flow_kg_s = 0.0;
  std::vector<LuCase> cases;
};

LuStudy run_lu_study(
    const LuOptions& options, const std::function<void(double)>& progress = [](double) {});

}  // namespace ehm::tuner_design
