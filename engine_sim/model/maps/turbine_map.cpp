// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/maps/turbine_map.h"

#include <stdexcept>

namespace ehm::engine_sim {

TurbineMap::TurbineMap(const TurbineMapData& data)
    : data_(data),
      numbers_(own_numbers({&data_.speed_breaks, &data_.pressure_ratio_breaks, &data_.flow, &data_.efficiency})),
      speed_(data.speed_breaks),
      pressure_ratio_(data.pressure_ratio_breaks) {
  const std::size_t expected = speed_.size() * pressure_ratio_.size();
  if (data.flow.size() != expected || data.efficiency.size() != expected) {
    throw std::invalid_argument("turbine map: a coefficient table does not fit its break points");
  }
}

}  // namespace ehm::engine_sim
