#include "monitor/checks/innovation_gate.h"

namespace ehm::monitor {

GateDecision innovation_gate(const estimation::SensorVector& innovation, const estimation::SensorVector& variance,
                             estimation::SensorMask offered, double gate_sigma) noexcept {
  GateDecision decision;
  decision.ratio = innovation.array().square() / (gate_sigma * gate_sigma * variance.array());
  estimation::SensorMask outside;
  for (int i = 0; i < innovation.size(); ++i)
    if (offered[static_cast<std::size_t>(i)] && decision.ratio(i) > 1.0) outside.set(static_cast<std::size_t>(i));
  if (outside.count() == 1) decision.rejected = outside;
  return decision;
}

}  // namespace ehm::monitor
