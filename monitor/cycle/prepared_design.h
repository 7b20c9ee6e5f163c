#pragma once
// A design made ready to fly: what is constant in the cycles of all engines of one design, computed once and shared.
//
// @throws std::invalid_argument if the design's matrices do not fit together, or its tuners' noise is not definite.

#include <memory>
#include <vector>

#include "monitor/design/design.h"
#include "monitor/estimation/error_propagation.h"
#include "monitor/estimation/tuner_filter.h"
#include "monitor/judge/fault_signatures.h"
#include "monitor/judge/fleet_watch.h"
#include "monitor/judge/shift_detector.h"
#include "monitor/judge/slow_bias.h"

namespace ehm::monitor {

struct PreparedDesign {
  explicit PreparedDesign(std::shared_ptr<const design::Design> design);

  std::shared_ptr<const design::Design> design;
  estimation::TunerFilter filter;  ///< has seen nothing yet; copies share their matrices
  std::shared_ptr<const std::vector<estimation::ErrorModel>> error_models;  ///< [0] full set, [1 + i] without sensor i
  std::shared_ptr<const FaultTables> faults;
  std::shared_ptr<const ShiftTables> shift;
  std::shared_ptr<const SlowBiasTable> slow_bias;
  std::shared_ptr<const FleetTables> fleet;
};

}  // namespace ehm::monitor
