// SPDX-License-Identifier: Apache-2.0
#pragma once
// From a design to the estimators that can fly it. estimator_kinds() is the table of all of them: a further one is a
// file in estimation/, a line there, and a row of the shared suite (tests/unit/monitor/estimation/estimator_test.cpp).

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "monitor/data/options.h"
#include "monitor/design/design.h"
#include "monitor/estimation/estimator.h"
#include "monitor/estimation/point_distance.h"
#include "monitor/estimation/tuner_estimator.h"

namespace ehm::design {

inline constexpr const char* tuner_name = "tuner";
inline constexpr const char* on_board_name = "onboard";
inline constexpr const char* scheduled_name = "scheduled";
inline constexpr const char* constrained_name = "constrained";

/// What an estimator is made of: the design's own matrices, the engine that it was made of, or its schedule.
enum class EstimatorBasis { design, engine, schedule };

struct EstimatorKind {
  const char* name;         ///< in configuration, on the wire, in recordings
  const char* description;  ///< for people who choose
  EstimatorBasis basis;
  std::unique_ptr<estimation::Estimator> (*make)(const Design& design, const monitor::EstimatorOptions& options,
                                                 const estimation::PointDistance& distance);
};

/// All of them, the tuner filter first.
std::span<const EstimatorKind> estimator_kinds() noexcept;

/// That a recording has rows for (deploy/runtime/recording/row.h).
inline constexpr std::size_t max_shadows = 32;

/// The names in estimator.shadow, in their order.
/// @throws std::invalid_argument (value, allowed) if one is not known, stands twice, is published, or is one too many.
std::vector<std::string> shadow_names(const monitor::EstimatorOptions& options);

/// The published one and the shadows, without the tuner filter, which flies in any case; names of the table.
/// @throws std::invalid_argument as shadow_names, or if the published one is not known.
std::vector<std::string_view> companion_names(const monitor::EstimatorOptions& options);

/// What is published is the on-board estimator's, constrained or not: it learns from flight to flight.
bool publishes_on_board(const monitor::EstimatorOptions& options) noexcept;

/// The table's own text of a name, which lives for ever; empty if it has none such.
std::string_view known_name(std::string_view name) noexcept;
/// All names, with commas between.
std::string known_names();

/// @throws std::invalid_argument if the name is not one of the table (names those that are), or the design has not
/// what it needs.
std::unique_ptr<estimation::Estimator> make_estimator(const std::string& name, const Design& design,
                                                      const monitor::EstimatorOptions& options,
                                                      const monitor::ValidityOptions& validity);

/// The tuner filter's constants.
/// @throws std::invalid_argument if the design's matrices do not fit together.
estimation::TunerEstimatorModel make_tuner_model(const Design& design);

}  // namespace ehm::design
