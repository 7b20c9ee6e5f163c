#include "monitor/export/status_board.h"

#include <spdlog/fmt/fmt.h>

#include "monitor/realtime/clock.h"

namespace ehm::monitor {

bool StatusBoard::hang_up(const MonitorStatus& status) {
  const std::lock_guard lock(mutex_);
  EngineView& engine = engines_[status.engine_id()];
  const bool changed = engine.status_ns == 0 || engine.status.level() != status.level();
  engine.status = status;
  engine.status_ns = monotonic_ns();
  return changed;
}

void StatusBoard::hang_up(const HealthEvent& event) {
  const std::lock_guard lock(mutex_);
  EngineView& engine = engines_[event.engine_id()];
  const bool raised = event.raised() != 0;
  if (raised && event.kind() < engine.raised.size()) ++engine.raised[event.kind()];
  engine.conditions[{event.kind(), event.channel()}] = {event.channel_name().c_str(), raised};
}

void StatusBoard::hang_up(const EngineDescription& description) {
  const std::lock_guard lock(mutex_);
  EngineView& engine = engines_[description.engine_id()];
  engine.design_hash = description.design_hash().c_str();
  engine.engine_type = description.engine_type().c_str();
}

FleetView StatusBoard::view() const {
  const std::lock_guard lock(mutex_);
  return engines_;
}

std::string StatusBoard::summary() const {
  std::map<std::uint32_t, int> count;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [id, engine] : engines_)
      if (engine.status_ns != 0) ++count[engine.status.level()];
  }
  int engines = 0;
  std::string levels;
  for (const auto& [level, n] : count) {
    engines += n;
    levels += fmt::format("{} {} {}", levels.empty() ? ":" : ",", n, wire::level_name(level));
  }
  return fmt::format("{} engine{}{}", engines, engines == 1 ? "" : "s", levels);
}

}  // namespace ehm::monitor
