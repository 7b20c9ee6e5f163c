// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tables I to III of Endurthi's thesis on our engine: the 27 linear models (linear_models.h) and the tangent against the
// nonlinear engine in its closed loop, all health parameters and initial states perturbed by 0.01, 0.1 or 0.5 % of their
// values, downwards, and the models made with steps of the same sizes, over 6 s (model_error.h).
// A health parameter's value is 1 for the new engine.
//
// With smooth maps methods 0 and 1 are nearly one, and LINxy1 does not fail as it does in the thesis, whose maps have
// corners and whose solver stops early. So table III is made a second time on our engine with a corner in every health
// parameter's influence, less far from trim than the perturbation and further than linmod's step: open loop.
// Errors: those of the engine, of block_columns.h and of step_study.h.

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tuner_design/endurthi/linear_models.h"
#include "tuner_design/endurthi/model_error.h"

namespace ehm::tuner_design::endurthi {

inline constexpr std::array<double, 3> studied_percents{0.01, 0.1, 0.5};
inline constexpr double corner_health = -3e-5, corner_steeper = 0.003;  ///< where, and how much steeper beyond

struct LinearisationStudyOptions {
  std::shared_ptr<const engine_sim::EngineDefinition> engine;
  unsigned threads = 1;
};

using ModelErrors = std::array<ModelError, model_count + 1>;  ///< the last is the tangent's
inline constexpr std::size_t tangent_model = model_count;

/// Figure 5.2: the sensors after a perturbation of 0.5 %, by the nonlinear engine, by LIN002, whose steps were 0.01 %,
/// and by the tangent; percent of trim, m x samples.
struct LinearisationTrace {
  std::vector<std::string> sensors;
  double step_s = 0.0;
  Eigen::MatrixXd nonlinear, model, tangent;
};
inline constexpr std::size_t traced_model = 2;

struct LinearisationPoint {
  std::string name;
  double n1_rpm = 0.0;
  /// By perturbation of linearisation, by perturbation under test.
  std::array<std::array<ModelErrors, studied_percents.size()>, studied_percents.size()> errors;
  ModelErrors with_corner;  ///< both perturbations 0.01 %
  LinearisationTrace trace;
  /// Models that are one (linear_models.h), by perturbation of linearisation.
  std::array<std::vector<std::vector<std::size_t>>, studied_percents.size()> groups;
};

struct LinearisationStudy {
  LinearisationStudyOptions options;
  std::vector<LinearisationPoint> points;
};

inline constexpr double closeness = 1e-3;

/// `progress`: share of the work.
LinearisationStudy run_linearisation_study(
    const LinearisationStudyOptions& options, const std::function<void(double)>& progress = [](double) {});

}  // namespace ehm::tuner_design::endurthi
