// SPDX-License-Identifier: Apache-2.0
#include "monitor/estimation/steady_gain.h"
#include "tuner_design/monte_carlo/truth.h"

namespace ehm::tuner_design {

Truth linear_truth(const design::Design& design) {
  const estimation::SteadyGain steady = estimation::steady_gain(design.model);
  return {"the design's own linear model", false,
          [H = steady.H, Hz = steady.Hz,
           nu = design.model.B.cols()](const estimation::HealthVector& health) -> std::optional<EngineInBalance> {
            return EngineInBalance{H * health, Hz * health, estimation::ActuatorVector::Zero(nu)};
          }};
}

}  // namespace ehm::tuner_design
