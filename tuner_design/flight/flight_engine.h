// SPDX-License-Identifier: Apache-2.0
#pragma once
// One engine of a flight study: worn, built, and flown over the two-hour mission, with the on-board estimator beside
// it. The truth is a Simulation whose mismatch the estimator does not know; both get the same seed's engine on any
// number of threads. A coarser step than 15 ms has less noise, so that a second brings equal information.
// Errors: @throws engine_sim::FlightError if the engine does not fly (says when and why).

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine_sim/engines/engine_definition.h"
#include "monitor/estimation/estimator.h"
#include "monitor/onboard/on_board_model.h"
#include "tuner_design/flight/mission_scenario.h"

namespace ehm::tuner_design {

struct FlightStudyOptions {
  std::shared_ptr<const engine_sim::EngineDefinition> engine;
  std::size_t engines = 100;
  double step_s = 0.1;
  MissionDraw draw;                  ///< of the truth
  std::vector<std::size_t> missing;  ///< sensors that are dead from the start
  onboard::OnBoardOptions onboard;   ///< sample_time_s is step_s
  /// Which estimator flies in place of the on-board one; made for step_s.
  std::shared_ptr<const estimation::Estimator> estimator;
  unsigned threads = 1;
};

/// Health or an auxiliary output over the flight: how often the truth lies within 1.96 sigma, and the error.
struct ChannelScore {
  std::size_t judged = 0, covered = 0;
};

/// What the estimator said of a step, or of a biased sensor: of the one that there was, and of such as there were not.
struct Finding {
  std::optional<double> found_after_s;
  bool named = false;  ///< the right parameter, or sensor
  int false_alarms = 0;
};

struct FlightOutcome {
  double samples = 0, estimated = 0;
  double ssee_700 = 0, claim_700 = 0, ssee_landing = 0, claim_landing = 0;  ///< percent^2, of all health
  std::vector<ChannelScore> health;                                         ///< from take-off to landing
  Finding step, bias;
  std::vector<ChannelScore> steady, slam;  ///< of auxiliary outputs: in cruise, and in the 30 s after the slams
};

/// The engine as its file says, but with the lags of a mission where the file states none, and the noise of a step, of
/// the present reading. Truth and estimator know the same of it.
std::shared_ptr<const engine_sim::EngineDefinition> flown_engine(const engine_sim::EngineDefinition& engine,
                                                                 double step_s);

FlightOutcome fly(const FlightStudyOptions& options, std::shared_ptr<const onboard::OnBoardModel> model,
                  std::size_t index);

}  // namespace ehm::tuner_design
