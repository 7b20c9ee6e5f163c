// SPDX-License-Identifier: Apache-2.0
#pragma once
// The flight study: fleets against truths that differ more and more from the on-board model, and what is asked of them
// beside what was measured.
//   as filed     the truth is the engine file; the causes of mismatch are not asked for
//   build, soak  the build is drawn within its tolerance, the heat soak differs by 30 %
//   all          besides, air data and fuel meter have errors
//   step in ...  as `build, soak`, and in flight one health parameter steps by 2 %, in cruise or in the climb
//   without X    as `build, soak`, but sensor X is dead from the start; each of them, and one pair
// SSEE: sum over the health parameters of the squared error, percent^2, mean over the fleet; claims: the same of sigma.
// Errors: none; an engine that does not fly is named in its fleet, and is in no figure.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tuner_design/flight/flight_study.h"

namespace ehm::tuner_design {

struct FlightFleet {
  std::string name;
  FlightStudyOptions options;
  FleetResult result;
};

/// One line of the table: met where the value lies within what is asked.
struct FlightFigure {
  std::string what;
  double measured;
  std::optional<double> least, most;
  bool met() const { return !(least && measured < *least) && !(most && measured > *most); }
};

struct FlightStudy {
  std::vector<FlightFleet> fleets;
  std::vector<FlightFigure> figures;
  std::vector<std::string> health, auxiliary;  ///< names of the channels
};

/// `common`: engine, number of engines, seed, step and threads of every fleet. `scheduled`: another estimator that
/// flies two of the fleets as well; null: none does.
FlightStudy run_flight_study(
    const FlightStudyOptions& common, const std::shared_ptr<const estimation::Estimator>& scheduled,
    const std::function<void(double)>& progress = [](double) {});

}  // namespace ehm::tuner_design
