// SPDX-License-Identifier: Apache-2.0
#pragma once
// What one sensor's value tells by itself, before any model is asked: validity bit, finite, range, rate, and beside its
// last ones stuck or held (stuck_watch.h), or without its noise (quiet_watch.h).
//
// The result is a set of idl::reject_reason bits, 0 for a plausible value. A value that a slow sensor still holds is
// plausible, but no news: it is `repeated`, and fused once. Real-time safe: yes.

#include <cstdint>
#include <vector>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/linear_model.h"
#include "monitor/checks/quiet_watch.h"
#include "monitor/checks/stuck_watch.h"
#include "monitor/data/options.h"
#include "monitor/data/sample.h"
#include "monitor/estimation/estimator.h"

namespace ehm::monitor {

class SensorCheck {
 public:
  /// `span`: what healthy sensors read where the published estimator holds; the range is around it and the trim.
  /// One percent, of range and rate, is the largest of one percent of the trim's size (scaling.h), one sigma of the
  /// sensor's noise, and a tenth of what the fleet's health moves it by: the latter two where the trim has no size, or
  /// lies near zero.
  /// @throws std::invalid_argument if one of `sensors` names no sensor of the model (names those that it has).
  SensorCheck(const CheckOptions& options, const std::vector<SensorOptions>& sensors,
              const linear_model::LinearModel& model, const estimation::SensorSpan& span = {});

  /// `steps` sample times lie between this value and the last one.
  std::uint32_t reasons(const Sample& sample, int sensor, int steps) noexcept;
  /// Another source or time: nothing is compared with what came before.
  void reset() noexcept;
  /// Another estimator is published, which holds elsewhere.
  void use(const estimation::SensorSpan& span) noexcept;

  const StuckWatch& stuck(int sensor) const noexcept { return stuck_[as_size(sensor)]; }
  const QuietWatch& quiet(int sensor) const noexcept { return quiet_[as_size(sensor)]; }
  /// Samples for which a sensor holds each value without the design knowing; 1 for most.
  std::int64_t untold_hold(int sensor) const noexcept { return told_[as_size(sensor)] ? 1 : stuck(sensor).hold(); }

 private:
  struct Memory {
    double last = 0.0;
    bool has_last = false;
  };

  CheckOptions options_;
  std::vector<double> trim_, percent_;    ///< by sensor; what one percent is
  std::vector<double> least_, greatest_;  ///< of the range
  std::vector<Memory> memory_;
  std::vector<StuckWatch> stuck_;
  std::vector<QuietWatch> quiet_;
  std::vector<bool> may_be_quiet_;  ///< by sensor: its operator has not said that it is never stuck
  std::vector<bool> told_;          ///< by sensor: the model states its update period
};

/// What model and operator know of a sensor.
SensorKind sensor_kind(const CheckOptions& options, const std::vector<SensorOptions>& sensors,
                       const linear_model::LinearModel& model, std::size_t sensor);

}  // namespace ehm::monitor
