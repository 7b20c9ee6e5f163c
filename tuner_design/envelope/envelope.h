// SPDX-License-Identifier: Apache-2.0
#pragma once
// A schedule of point models: of an engine over its envelope, on a grid that is refined where interpolation misses
// most; or of models that a user has at several points.
//
//   refine   of the axes' intervals the one whose middle misses most, root mean square over the other axes and over
//            [x0 u0 y0 z0], relative to each quantity's size over the grid; until `most_nodes`
//   check    at random places within: what interpolation misses of the engine's own outputs, by channel; how many nodes
//            are valid, and whether each is stable
//
// Errors: @throws std::invalid_argument if models have other channels, or fill no grid of the variables (says which).

#include <functional>
#include <memory>
#include <vector>

#include "engine_sim/engines/engine_definition.h"
#include "engine_sim/linear_model/linear_model.h"
#include "monitor/schedule/schedule.h"
#include "tuner_design/envelope/engine_node.h"

namespace ehm::tuner_design {

struct EnvelopeOptions {
  std::shared_ptr<const engine_sim::EngineDefinition> engine;
  std::size_t most_nodes = 891;
  NodeOptions node;
  int checks = 300;  ///< random places
  unsigned threads = 1;
};

/// What interpolation misses of the engine's outputs, percent of each output's reading: root mean square and most.
struct InterpolationError {
  std::vector<double> rms_percent, most_percent;  ///< by sensor, then auxiliary output
  int places = 0, answered = 0;
};

struct EnvelopeResult {
  schedule::Schedule schedule;
  std::size_t valid = 0, unstable = 0;  ///< nodes
  InterpolationError error;
};

/// `progress`: share of the work, 0 to 1.
EnvelopeResult engine_envelope(const EnvelopeOptions& options, const std::function<void(double)>& progress);

/// `error_of_slopes`: relative; what is missed of readings without a stated linearisation error.
schedule::Schedule schedule_of_models(const std::vector<linear_model::LinearModel>& models,
                                      const std::vector<schedule::Variable>& variables, double error_of_slopes);

}  // namespace ehm::tuner_design
