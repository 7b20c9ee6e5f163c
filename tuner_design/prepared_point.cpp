#include "tuner_design/prepared_point.h"

#include <numeric>

#include "monitor/estimation/discretise.h"

namespace ehm::bench {

PreparedPoint prepare(const estimation::LinearModel& model) {
  PreparedPoint point;
  point.scaling = estimation::scaling_of(model);
  point.model = estimation::scaled(discretise(model), point.scaling);
  point.steady = estimation::steady_gain(point.model);
  return point;
}

std::vector<int> all_sensors(const estimation::LinearModel& model) {
  std::vector<int> all(model.sensors.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace ehm::bench
