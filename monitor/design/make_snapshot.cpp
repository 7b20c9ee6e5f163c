// SPDX-License-Identifier: Apache-2.0
#include "monitor/design/make_snapshot.h"

#include <utility>

#include "monitor/design/gauss_markov_design.h"
#include "monitor/design/scaled_design.h"
#include "monitor/estimation/snapshot/one_snapshot.h"
#include "monitor/estimation/snapshot/recursive_least_squares.h"
#include "monitor/estimation/snapshot/snapshot_estimator.h"

namespace ehm::design {
namespace {

using estimation::SnapshotWay;

std::unique_ptr<estimation::SnapshotMethod> make_method(SnapshotKind kind,
                                                        std::shared_ptr<const estimation::SnapshotModel> model,
                                                        double kept) {
  if (kind == SnapshotKind::rls) return std::make_unique<estimation::RecursiveLeastSquares>(std::move(model), kept);
  const SnapshotWay way = kind == SnapshotKind::map ? SnapshotWay::map : SnapshotWay::wls;
  return std::make_unique<estimation::OneSnapshot>(std::move(model), way);
}

}  // namespace

std::unique_ptr<estimation::Estimator> make_snapshot_estimator(SnapshotKind kind, const Design& design,
                                                               const monitor::EstimatorOptions& options,
                                                               const estimation::PointDistance& distance) {
  const linear_model::LinearModel model = discrete_scaled(design);
  auto setting = std::make_shared<estimation::SnapshotSetting>();
  setting->model = std::make_shared<const estimation::SnapshotModel>(estimation::snapshot_model(model));
  setting->units = units_of(design);
  if (kind == SnapshotKind::rls) setting->settling_samples = design.full.settling_samples(model.sample_time_s);
  auto method = make_method(kind, setting->model, rho_of(options.memory_s, model.sample_time_s));
  return std::make_unique<estimation::SnapshotEstimator>(std::move(setting), std::move(method), distance);
}

}  // namespace ehm::design
