// SPDX-License-Identifier: Apache-2.0
#include "monitor/diagnosis/limit_watch.h"

#include <algorithm>
#include <stdexcept>

namespace ehm::monitor {

namespace {

int find(const std::vector<linear_model::Channel>& channels, const std::string& name) {
  const auto found = std::find_if(channels.begin(), channels.end(), [&](const auto& c) { return c.name == name; });
  return found == channels.end() ? -1 : static_cast<int>(found - channels.begin());
}

std::string names(const std::vector<linear_model::Channel>& channels) {
  std::string list;
  for (const auto& c : channels) list += ' ' + c.name;
  return list;
}

}  // namespace

LimitWatch::LimitWatch(const std::vector<LimitOptions>& limits, const linear_model::LinearModel& model) {
  for (const auto& l : limits) {
    const int health = find(model.health, l.quantity), auxiliary = find(model.auxiliary, l.quantity);
    if (health < 0 && auxiliary < 0)
      throw std::invalid_argument("limit.quantity is '" + l.quantity + "', which the design does not estimate; it has" +
                                  names(model.health) + names(model.auxiliary));
    limits_.push_back({health >= 0 ? idl::EventKind::health_limit : idl::EventKind::auxiliary_limit,
                       health >= 0 ? health : auxiliary,
                       l.min,
                       l.max,
                       l.hysteresis,
                       {}});
  }
}

void LimitWatch::check(const estimation::HealthVector& health, const estimation::AuxiliaryVector& auxiliary,
                       EventList& events) noexcept {
  for (Limit& l : limits_) {
    const double value = l.kind == idl::EventKind::health_limit ? health(l.channel) : auxiliary(l.channel);
    const double margin = l.condition.raised() ? l.hysteresis : 0.0;
    const bool outside = value < l.min + margin || value > l.max - margin;
    const double threshold = value < 0.5 * (l.min + l.max) ? l.min : l.max;
    l.condition.set(outside, {l.kind, static_cast<std::uint32_t>(l.channel), false, value, threshold, 0}, events);
  }
}

}  // namespace ehm::monitor
