#pragma once
// The engines that an experiment flies on: constant health h, controls at the design's trim (u = 0: fuel flow, vanes
// and bleed valves are held), in balance from the first sample on.
//
//   linear      y = trim + H h,  z = trim + Hz h             the design's own model
//   nonlinear   y, z of the steady turbofan at the design's operating point with the worn components; the design's
//               trim is the origin of the deviations, wherever it lies (`linearise --method fleet` puts it into the
//               middle of the fleet, not on the new engine)
//
// With constant health and controls an engine in balance stays there, so that a steady solution is a whole flight. The
// filter's own start is cold, and so is the whole transient that it shows.

#include <functional>
#include <optional>
#include <string>

#include "monitor/design/design.h"
#include "monitor/estimation/capacity.h"

namespace ehm::bench {

/// Deviations from the design's trim, channel units, without noise.
struct EngineInBalance {
  estimation::SensorVector sensors;
  estimation::AuxiliaryVector auxiliary;
};

struct Truth {
  std::string description;
  bool nonlinear = false;
  /// The engine with this health (deviation from trim, channel units); nothing where it has no steady point. Callable
  /// by several threads at once.
  std::function<std::optional<EngineInBalance>(const estimation::HealthVector& health)> engine;
};

Truth linear_truth(const design::Design& design);

/// @throws std::invalid_argument if the design is not for the engine type jt9d, has no operating point, or has a
/// channel
///         that this engine does not know by name and unit; names it and what is known.
Truth nonlinear_truth(const design::Design& design);

}  // namespace ehm::bench
