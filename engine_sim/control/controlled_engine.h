#pragma once
// An engine and its control, one sample after another: measurements -> control -> actuators -> gas path -> spools.
//   measured at sample k: speeds and flight condition of k, T48 and Ps30 of the gas path of k - 1
//   fuel flow and geometry of sample k act from k to k + 1 and are in the gas path of k
// dt in s as in transient.h. Errors: those of Transient.

#include "engine_sim/control/engine_control.h"
#include "engine_sim/model/steady.h"
#include "engine_sim/model/transient.h"

namespace ehm::engine {

/// What acts on the engine besides its control.
struct Surroundings {
  FlightCondition flight{};
  HealthVector health{};
  Offtake offtake{};
};

struct ControlledSample {
  Actuation actuation;
  GasPath gas;
};

class ControlledEngine {
 public:
  /// `start` has vanes and valves on their schedules, see settled() below.
  ControlledEngine(const Turbofan& engine, const ControlData& data, const SteadyPoint& start);

  /// The sample of now, and on to the next one.
  ControlledSample step(const Surroundings& surroundings, double n1_demand_rpm, double dt_s);
  SpoolSpeeds speeds() const { return transient_.speeds(); }

 private:
  const Turbofan& engine_;
  EngineControl control_;
  Transient transient_;
  Measurements measured_;
};

/// Steady point with the bleed valves where the control wants them. Demand as in solve_steady().
/// @throws as solve_steady()
SteadyPoint solve_scheduled(const Turbofan& engine, const ControlData& data, const Surroundings& surroundings,
                            const Demand& demand, const SteadyPoint* start = nullptr);

/// Steady point that the control holds at this fan speed demand: at the demand, or at the limit that stops it.
/// @throws SolveError if the engine does not run there at any fan speed that the control allows
SteadyPoint settled(const Turbofan& engine, const ControlData& data, const Surroundings& surroundings,
                    double n1_demand_rpm);

}  // namespace ehm::engine
