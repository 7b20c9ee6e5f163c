// SPDX-License-Identifier: Apache-2.0
#include "monitor/checks/innovation_gate.h"

#include <cmath>

#include "deploy/runtime/numbers/index.h"

namespace ehm::monitor {

namespace {

/// Do these sensors together disagree with the prediction more than noise explains?
bool restless(const estimation::SensorVector& ratio, estimation::SensorMask sensors, double gate_sigma) noexcept {
  double sum = 0.0;
  for (int i = 0; i < ratio.size(); ++i)
    if (sensors[as_size(i)]) sum += gate_sigma * gate_sigma * ratio(i);
  const auto count = static_cast<double>(sensors.count());
  return sum > count + 4.0 * std::sqrt(2.0 * count);
}

}  // namespace

GateDecision innovation_gate(const estimation::SensorVector& innovation, const estimation::SensorVector& variance,
                             estimation::SensorMask offered, double gate_sigma) noexcept {
  GateDecision decision;
  decision.ratio = innovation.array().square() / (gate_sigma * gate_sigma * variance.array());
  estimation::SensorMask outside;
  for (int i = 0; i < innovation.size(); ++i)
    if (offered[as_size(i)] && decision.ratio(i) > 1.0) outside.set(as_size(i));
  if (outside.count() == 1 && !restless(decision.ratio, offered & ~outside, gate_sigma)) decision.rejected = outside;
  return decision;
}

}  // namespace ehm::monitor
