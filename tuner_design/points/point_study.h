// SPDX-License-Identifier: Apache-2.0
#pragma once
// The tuner filter at single operating points, from approach to take-off, against the nonlinear engine:
//   with Lambda      linearised over the fleet; what the model misses counts in the estimate (theory/read_out.h)
//   without          the same model, as if it missed nothing: what the filter then gets wrong, and what it claims
// each flown over engines that neither has seen, with errors and claims of the same window (monte_carlo/evaluation.h).
// And one V* for all points, as squared error of health over each point's limit, mean and worst (design/shared_tuners.h):
//   the last cruise point's V*, and the closed form of all with m, m + 1 and m + 2 tuners.
// Asked: SSEE(h) with Lambda at most 16 percent^2, and within 10 % of its claim, at every point.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine_sim/engines/engine_definition.h"
#include "engine_sim/model/solve/steady.h"

namespace ehm::tuner_design {

struct StudiedPoint {
  const char* name;
  engine_sim::FlightCondition flight;
  double share;  ///< of the design point's corrected fan speed
};

inline constexpr double asked_ssee = 16.0, asked_claim = 0.10;

/// The nine of the study; the last cruise point is the one whose V* stands for "one point's".
const std::vector<StudiedPoint>& studied_points();
inline constexpr std::size_t cruise_point = 7;

struct PointStudyOptions {
  std::shared_ptr<const engine_sim::EngineDefinition> engine;
  std::size_t engines = 200;  ///< that fly at each point
  int fleet = 2000;           ///< that each point is linearised over
  std::uint64_t seed = 1;     ///< of the engines that fly
  unsigned threads = 1;
};

/// Squared error of health, percent^2.
struct PointError {
  double flown = 0.0, standard_error = 0.0, claimed = 0.0;
  double worst_coverage = 0.0;  ///< of the channels of health
};

struct PointResult {
  std::string name;
  double n1_rpm = 0.0;
  double limit = 0.0;  ///< with Lambda
  PointError with, without;
};

struct SharedTuners {
  std::string name;
  Eigen::Index tuners = 0;
  double mean = 0.0, worst = 0.0;  ///< SSEE(h) over the point's limit
};

struct PointStudy {
  PointStudyOptions options;
  std::vector<PointResult> points;
  std::vector<SharedTuners> shared;
};

/// `progress`: share of the work. @throws what linearise, design_tuner and evaluate throw.
PointStudy run_point_study(
    const PointStudyOptions& options, const std::function<void(double)>& progress = [](double) {});

}  // namespace ehm::tuner_design
