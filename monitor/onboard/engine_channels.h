// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the channels of an engine say of a gas path, and how that changes with the spools' speeds and the health:
//   readings  m    channel units          rates  2    d(dN/dt), percent of the design speeds a second
//   outputs   r    channel units          a row of slopes: d(quantity)/d(N1, N2, h), each by one percent
// Shapes: a row has 2 + p elements. Errors: none. Real-time safe: yes.

#include <memory>

#include "engine_sim/model/onboard/gas_path_jacobian.h"
#include "monitor/onboard/unknowns.h"

namespace ehm::onboard {

class EngineChannels {
 public:
  explicit EngineChannels(std::shared_ptr<const OnBoardModel> model);

  estimation::SensorVector readings(const engine_sim::GasPath& gas) const noexcept;
  estimation::AuxiliaryVector outputs(const engine_sim::GasPath& gas) const noexcept;
  Eigen::Vector2d rates(const engine_sim::GasPath& gas) const noexcept;
  /// rpm of one percent
  const Eigen::Array2d& speed_unit() const noexcept { return speed_unit_; }

  /// factor times the row of that quantity (gas_path_quantities.h) by speeds and health.
  template <class Row>
  void slopes(const engine_sim::GasPathJacobian& jacobian, std::size_t quantity, double factor,
              Row&& target) const noexcept {
    namespace input = engine_sim::gas_path_input;
    const auto row = as_index(quantity);
    for (Eigen::Index k = 0; k < speed_count; ++k)
      target(k) = factor * jacobian(row, as_index(input::n1) + k) * speed_unit_(k);
    const auto& health = model_->definition().channels.health;
    for (std::size_t j = 0; j < health.size(); ++j)
      target(UnknownLayout::first_health() + as_index(j)) =
          0.01 * factor * jacobian(row, as_index(input::of(health[j].parameter)));
  }

 private:
  std::shared_ptr<const OnBoardModel> model_;
  Eigen::Array2d speed_unit_;
};

}  // namespace ehm::onboard
