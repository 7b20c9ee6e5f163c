#include "engine_sim/model/transient.h"

#include <stdexcept>
#include <string>

namespace ehm::engine {

Transient::Transient(const Turbofan& engine, const SteadyPoint& start)
    : engine_(engine), speeds_(start.gas.speeds), unknowns_(start.unknowns) {}

GasPath Transient::output(const Operation& operation) {
  if (!present_ || !(present_->operation == operation)) {
    present_ = Solved{operation, engine_.gas_path(operation, speeds_, unknowns_)};
  }
  return present_->gas;
}

void Transient::step(const Operation& operation, double dt_s) {
  if (!(dt_s > 0.0 && dt_s <= 0.1)) {
    throw std::invalid_argument("transient: dt_s = " + std::to_string(dt_s) + " is outside 0 to 0.1");
  }
  const GasPath now = output(operation);
  // N* = N + dt f(N)
  const SpoolSpeeds ahead{speeds_.n1_rpm + dt_s * now.n1_dot_rpm_s, speeds_.n2_rpm + dt_s * now.n2_dot_rpm_s};
  const GasPath then = engine_.gas_path(operation, ahead, unknowns_);
  // N <- N + dt/2 (f(N) + f(N*))
  speeds_.n1_rpm += 0.5 * dt_s * (now.n1_dot_rpm_s + then.n1_dot_rpm_s);
  speeds_.n2_rpm += 0.5 * dt_s * (now.n2_dot_rpm_s + then.n2_dot_rpm_s);
  present_.reset();
}

}  // namespace ehm::engine
