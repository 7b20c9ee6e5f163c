// SPDX-License-Identifier: Apache-2.0
#pragma once
// A design made ready to fly: what is constant in the cycles of all engines of one design, computed once and shared.
//
// @throws std::invalid_argument if the design's matrices do not fit together, its tuners' noise is not definite, or an
// estimator of the options is not known, is asked for twice, or cannot be made of this design.

#include <memory>
#include <vector>

#include "monitor/cycle/companion_estimators.h"
#include "monitor/data/options.h"
#include "monitor/design/design.h"
#include "monitor/design/make_estimator.h"
#include "monitor/diagnosis/fault_signatures.h"
#include "monitor/diagnosis/fleet_watch.h"
#include "monitor/diagnosis/shift_detector.h"
#include "monitor/diagnosis/slow_bias.h"
#include "monitor/estimation/tuner_estimator.h"

namespace ehm::monitor {

inline constexpr int watch_filter = -1;  ///< the tuner filter itself, in the place of an index of a companion

struct PreparedDesign {
  explicit PreparedDesign(std::shared_ptr<const design::Design> design, const CycleOptions& options = {});
  /// It serves cycles with these options too.
  bool serves(const CycleOptions& options) const noexcept {
    return options.estimator == estimator && options.validity == validity;
  }

  /// What healthy sensors read where that estimator holds.
  estimation::SensorSpan span(int of) const {
    return of == watch_filter ? estimation::SensorSpan{} : companions[as_size(of)].span;
  }

  std::shared_ptr<const design::Design> design;
  EstimatorOptions estimator;
  ValidityOptions validity;
  estimation::TunerEstimatorModel tuner;
  std::vector<Companion> companions;  ///< those that fly beside the tuner filter
  int published = watch_filter;       ///< index into companions, or watch_filter
  std::vector<int> shadows;           ///< the same, in the order of the options
  std::shared_ptr<const FaultTables> faults;
  std::shared_ptr<const ShiftTables> shift;
  std::shared_ptr<const SlowBiasTable> slow_bias;
  std::shared_ptr<const FleetTables> fleet;
};

}  // namespace ehm::monitor
