#pragma once
// Spool dynamics at a fixed step: dN/dt from the power left over on each shaft, the flow balance closed at each stage.
//   Heun (second order): N* = N + dt f(N),  N <- N + dt/2 (f(N) + f(N*)),  operation held over the step
// States: N1, N2 in rpm; dt in s. The volumes of the gas path are quasi-steady: they fill in milliseconds.
// Errors: those of Turbofan::gas_path; @throws std::invalid_argument if dt_s is not within 0 to 0.1 s.
// Source: Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I, II.1 (Heun's second-order method).

#include <optional>

#include "engine_sim/model/steady.h"
#include "engine_sim/model/turbofan.h"

namespace ehm::engine {

class Transient {
 public:
  Transient(const Turbofan& engine, const SteadyPoint& start);

  /// Gas path at the present speeds with this operation acting now.
  GasPath output(const Operation& operation);
  /// Advances the spool speeds by dt_s.
  void step(const Operation& operation, double dt_s);
  SpoolSpeeds speeds() const { return speeds_; }

 private:
  struct Solved {
    Operation operation;
    GasPath gas;
  };

  const Turbofan& engine_;
  SpoolSpeeds speeds_;
  FlowUnknowns unknowns_;
  std::optional<Solved> present_;  ///< solved at the present speeds, so that step() after output() solves it once
};

}  // namespace ehm::engine
