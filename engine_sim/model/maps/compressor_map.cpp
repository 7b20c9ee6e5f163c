// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/maps/compressor_map.h"

#include <cmath>
#include <stdexcept>

#include "deploy/runtime/numbers/index.h"

namespace ehm::engine_sim {
namespace {

/// Below `knee` the efficiency decays with the same slope to `floor`: in deep choke the ideal work goes to zero, and so
/// does the work = ideal work / efficiency.
SurfaceValue positive(const SurfaceValue& s) {
  constexpr double knee = 0.2, floor = 0.05;
  if (s.f >= knee) return s;
  const double decay = std::exp((s.f - knee) / (knee - floor));
  return {floor + (knee - floor) * decay, s.by_x * decay, s.by_y * decay};
}

}  // namespace

CompressorMap::CompressorMap(const CompressorMapData& data)
    : data_(data),
      numbers_(own_numbers({&data_.speed_breaks, &data_.r_line_breaks, &data_.flow, &data_.pressure, &data_.efficiency,
                            &data_.surge_flow_breaks, &data_.surge_pressure_ratio})),
      speed_(data.speed_breaks),
      r_line_(data.r_line_breaks),
      surge_(data.surge_flow_breaks) {
  const std::size_t expected = speed_.size() * r_line_.size();
  if (data.flow.size() != expected || data.pressure.size() != expected || data.efficiency.size() != expected ||
      data.surge_pressure_ratio.size() != surge_.size()) {
    throw std::invalid_argument("compressor map: a coefficient table does not fit its break points");
  }
}

CompressorMap::Values CompressorMap::values(double speed, double r_line) const {
  const BasisValues n = speed_.at(speed);
  const BasisValues r = r_line_.at(r_line);
  const std::size_t columns = r_line_.size();
  return {surface(n, r, data_.flow, columns), surface(n, r, data_.pressure, columns),
          positive(surface(n, r, data_.efficiency, columns))};
}

CompressorMap::SurgeValue CompressorMap::surge(double flow) const {
  const BasisValues w = surge_.at(flow);
  SurgeValue s{0.0, 0.0};
  for (std::size_t i = 0; i < 4; ++i) {
    const double coefficient = data_.surge_pressure_ratio[w.first + i];
    s.pressure_ratio += w.b[as_index(i)] * coefficient;
    s.by_flow += w.slope[as_index(i)] * coefficient;
  }
  return s;
}

}  // namespace ehm::engine_sim
