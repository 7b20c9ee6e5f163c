// SPDX-License-Identifier: Apache-2.0
#include "monitor/dds/input_watch.h"

#include <spdlog/fmt/fmt.h>

#include "monitor/realtime/clock.h"

namespace ehm::monitor {

idl::InputRequest InputWatch::request() {
  return {deadline_s_, lease_s_, [this](std::uint32_t engine_id) { deadline_missed(engine_id, monotonic_ns()); },
          [this](int alive_change, int not_alive_change) { liveliness_changed(alive_change, not_alive_change); }};
}

void InputWatch::deadline_missed(std::uint32_t engine_id, std::int64_t now_ns) {
  deadline_misses_.fetch_add(1, std::memory_order_relaxed);
  const std::lock_guard lock(mutex_);
  if (late_.insert_or_assign(engine_id, now_ns).second)
    notices_.post({.kind = idl::EventKind::input_deadline,
                   .raised = true,
                   .text = fmt::format("no sample within the deadline of {:.3g} s that its source offers", deadline_s_),
                   .engine_id = engine_id,
                   .value = deadline_s_,
                   .threshold = deadline_s_});
}

void InputWatch::settle(std::int64_t now_ns) {
  const auto calm_ns = static_cast<std::int64_t>(2e9 * deadline_s_);
  const std::lock_guard lock(mutex_);
  for (auto it = late_.begin(); it != late_.end();) {
    if (now_ns - it->second < calm_ns) {
      ++it;
      continue;
    }
    notices_.post({.kind = idl::EventKind::input_deadline,
                   .text = "samples keep the deadline again",
                   .engine_id = it->first,
                   .threshold = deadline_s_});
    it = late_.erase(it);
  }
}

void InputWatch::liveliness_changed(int alive_change, int not_alive_change) {
  const std::lock_guard lock(mutex_);
  if (not_alive_change > 0) {
    liveliness_losses_.fetch_add(static_cast<std::uint64_t>(not_alive_change), std::memory_order_relaxed);
    lifeless_ = true;
    notices_.post({.kind = idl::EventKind::input_liveliness,
                   .raised = true,
                   .text = fmt::format("a source of EngineSensors has given no sign of life for {:.3g} s", lease_s_),
                   .value = lease_s_,
                   .threshold = lease_s_});
  } else if (alive_change > 0 && lifeless_) {
    lifeless_ = false;
    notices_.post({.kind = idl::EventKind::input_liveliness,
                   .text = "a source of EngineSensors is alive again",
                   .threshold = lease_s_});
  }
}

}  // namespace ehm::monitor
