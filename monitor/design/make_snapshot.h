// SPDX-License-Identifier: Apache-2.0
#pragma once
// From a design's linear model to the estimators on snapshots (estimation/snapshot). They use its model, noise, spread
// of health and scaling, and none of its tuners. @throws std::invalid_argument if the model exceeds the capacity;
// std::runtime_error if I - A is singular or A not stable.

#include <memory>

#include "monitor/data/options.h"
#include "monitor/design/design.h"
#include "monitor/estimation/estimator.h"
#include "monitor/estimation/point_distance.h"

namespace ehm::design {

enum class SnapshotKind { map, wls, rls };

/// rls forgets within options.memory_s.
std::unique_ptr<estimation::Estimator> make_snapshot_estimator(SnapshotKind kind, const Design& design,
                                                               const monitor::EstimatorOptions& options,
                                                               const estimation::PointDistance& distance);

}  // namespace ehm::design
