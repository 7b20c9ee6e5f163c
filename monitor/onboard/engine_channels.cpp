// SPDX-License-Identifier: Apache-2.0
#include "monitor/onboard/engine_channels.h"

#include <utility>

namespace ehm::onboard {
namespace {

using estimation::AuxiliaryVector;
using estimation::SensorVector;

}  // namespace

EngineChannels::EngineChannels(std::shared_ptr<const OnBoardModel> model)
    : model_(std::move(model)),
      speed_unit_(0.01 * model_->engine().data().design.speeds.n1_rpm,
                  0.01 * model_->engine().data().design.speeds.n2_rpm) {}

SensorVector EngineChannels::readings(const engine_sim::GasPath& gas) const noexcept {
  const auto& sensors = model_->definition().channels.sensors;
  SensorVector y(as_index(sensors.size()));
  for (std::size_t i = 0; i < sensors.size(); ++i)
    y(as_index(i)) = sensors[i].quantity->read(gas, model_->engine().data().ratings);
  return y;
}

AuxiliaryVector EngineChannels::outputs(const engine_sim::GasPath& gas) const noexcept {
  const auto& outputs = model_->definition().channels.auxiliary;
  AuxiliaryVector z(as_index(outputs.size()));
  for (std::size_t i = 0; i < outputs.size(); ++i)
    z(as_index(i)) = outputs[i]->read(gas, model_->engine().data().ratings);
  return z;
}

Eigen::Vector2d EngineChannels::rates(const engine_sim::GasPath& gas) const noexcept {
  return {gas.n1_dot_rpm_s / speed_unit_(0), gas.n2_dot_rpm_s / speed_unit_(1)};
}

}  // namespace ehm::onboard
