#include "monitor/checks/sensor_check.h"

#include <algorithm>
#include <cmath>

#include "idl/wire_values.h"
#include "monitor/estimation/scaling.h"

namespace ehm::monitor {

namespace reason = wire::reject_reason;

SensorCheck::SensorCheck(const CheckOptions& options, const estimation::LinearModel& model)
    : options_(options), memory_(model.sensors.size()) {
  for (std::size_t i = 0; i < model.sensors.size(); ++i) {
    trim_.push_back(model.sensors[i].trim);
    percent_.push_back(
        estimation::percent_of_trim(model.sensors[i], model.sensor_noise_sigma(static_cast<Eigen::Index>(i))));
  }
}

std::uint32_t SensorCheck::reasons(const Sample& sample, int sensor, int steps) noexcept {
  const auto i = static_cast<std::size_t>(sensor);
  Memory& memory = memory_[i];
  const double value = sample.sensor[i];
  if (!(sample.sensor_valid >> sensor & 1u)) return reason::source_invalid;
  if (!std::isfinite(value)) return reason::not_finite;

  std::uint32_t reasons = 0;
  if (std::abs(value - trim_[i]) > options_.range_percent * percent_[i]) reasons |= reason::range;
  if (memory.has_last) {
    if (std::abs(value - memory.last) > options_.rate_percent * percent_[i] * std::max(1, steps))
      reasons |= reason::rate;
    memory.equal = value == memory.last ? memory.equal + 1 : 0;
    if (memory.equal + 1 >= options_.stuck_samples) reasons |= reason::stuck;
  }
  memory.last = value;
  memory.has_last = true;
  return reasons;
}

void SensorCheck::reset() noexcept {
  std::fill(memory_.begin(), memory_.end(), Memory{});
}

}  // namespace ehm::monitor
