// SPDX-License-Identifier: Apache-2.0
#include "monitor/listen/suspicion.h"

#include <spdlog/fmt/fmt.h>

#include <cmath>

#include "deploy/runtime/numbers/index.h"
#include "deploy/runtime/units/units.h"

namespace ehm::monitor {

namespace {

bool near(double value, const Expectation& e, Eigen::Index i) {
  return std::abs(value - e.value(i)) <= implausible_spreads * e.spread(i);
}

/// Both values are right where the other stands, and wrong where they stand.
std::string swap_partner(const std::vector<linear_model::Channel>& sensors, const Eigen::VectorXd& mean,
                         const Expectation& e, Eigen::Index i) {
  for (Eigen::Index j = 0; j < mean.size(); ++j)
    if (j != i && near(mean(i), e, j) && near(mean(j), e, i) && !near(mean(j), e, j))
      return "; swapped with " + sensors[as_size(j)].name + "?";
  return "";
}

std::string other_place(const std::vector<linear_model::Channel>& sensors, const Eigen::VectorXd& mean,
                        const Expectation& e, Eigen::Index i) {
  for (Eigen::Index j = 0; j < mean.size(); ++j)
    if (j != i && near(mean(i), e, j))
      return "; it would be right for " + sensors[as_size(j)].name + ", is the order right?";
  return "";
}

std::string unit_confusion(const linear_model::Channel& sensor, double mean, const Expectation& e, Eigen::Index i) {
  if (sensor.trim != 0.0 && near(0.01 * mean * sensor.trim, e, i)) return "; it looks like percent of trim";
  for (const std::string& other : units::relatives(sensor.unit))
    if (near((*units::conversion(other, sensor.unit))(mean), e, i))
      return fmt::format("; it looks like {}, {} is needed", other, sensor.unit);
  return "";
}

}  // namespace

std::vector<std::string> suspicions(const std::vector<linear_model::Channel>& sensors, const Eigen::VectorXd& mean,
                                    const Expectation& e) {
  std::vector<std::string> texts;
  for (Eigen::Index i = 0; i < mean.size(); ++i) {
    if (!std::isfinite(mean(i)) || near(mean(i), e, i)) continue;
    const linear_model::Channel& sensor = sensors[as_size(i)];
    std::string why = swap_partner(sensors, mean, e, i);
    if (why.empty()) why = unit_confusion(sensor, mean(i), e, i);
    if (why.empty()) why = other_place(sensors, mean, e, i);
    texts.push_back(fmt::format("sensor {}: mean {:.6g} {}, {:.6g} +- {:.3g} expected{}", sensor.name, mean(i),
                                sensor.unit, e.value(i), e.spread(i), why));
  }
  return texts;
}

}  // namespace ehm::monitor
