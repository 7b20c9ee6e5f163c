// SPDX-License-Identifier: Apache-2.0
#include "monitor/export/status_board.h"

#include <spdlog/fmt/fmt.h>

#include "deploy/runtime/numbers/index.h"
#include "monitor/realtime/clock.h"

namespace ehm::monitor {

namespace {

/// Events that happen and are over: nothing lasts that could end.
bool is_moment(std::uint32_t kind) {
  return kind == static_cast<std::uint32_t>(idl::EventKind::filter_restart) ||
         kind == static_cast<std::uint32_t>(idl::EventKind::checkpoint) ||
         kind == static_cast<std::uint32_t>(idl::EventKind::estimator_chosen);
}

}  // namespace

bool StatusBoard::post(const MonitorStatus& status) {
  const std::lock_guard lock(mutex_);
  EngineView& engine = engines_[status.engine_id()];
  const bool changed = engine.status_ns == 0 || engine.status.level() != status.level();
  engine.status = status;
  engine.status_ns = monotonic_ns();
  return changed;
}

void StatusBoard::post(const HealthEvent& event) {
  const std::lock_guard lock(mutex_);
  EngineView& engine = engines_[event.engine_id()];
  const bool raised = event.raised() != 0;
  if (raised && event.kind() < engine.raised.size()) ++engine.raised[event.kind()];
  if (!is_moment(event.kind()))
    engine.conditions[{event.kind(), event.channel()}] = {event.channel_name().c_str(), raised};
}

void StatusBoard::post(const EngineDescription& description) {
  const std::lock_guard lock(mutex_);
  EngineView& engine = engines_[description.engine_id()];
  engine.design_hash = description.design_hash().c_str();
  engine.engine_type = description.engine_type().c_str();
}

void StatusBoard::post(const FlightSummary& summary) {
  const std::lock_guard lock(mutex_);
  engines_[summary.engine_id()].flight = summary;
}

void StatusBoard::post(std::uint32_t engine_id, const linear_model::LinearModel& model,
                       const EstimateSnapshot& estimates) {
  std::vector<EstimateView> views;
  const auto add = [&](const char* kind, const auto& channels, const auto& values, const auto& sigmas) {
    for (std::size_t i = 0; i < channels.size(); ++i)
      views.push_back(
          {kind, channels[i].name, channels[i].unit, static_cast<double>(values[i]), static_cast<double>(sigmas[i])});
  };
  if (estimates.present) {
    add("health", model.health, estimates.health, estimates.health_sigma);
    add("auxiliary", model.auxiliary, estimates.auxiliary, estimates.auxiliary_sigma);
  }
  const std::lock_guard lock(mutex_);
  EngineView& engine = engines_[engine_id];
  engine.estimates = std::move(views);
  engine.estimators.assign(estimates.estimators.begin(),
                           estimates.estimators.begin() + as_index(estimates.estimator_count));
}

void StatusBoard::remove(std::uint32_t engine_id) {
  const std::lock_guard lock(mutex_);
  engines_.erase(engine_id);
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
    levels += fmt::format("{} {} {}", levels.empty() ? ":" : ",", n, idl::level_name(level));
  }
  return fmt::format("{} engine{}{}", engines, engines == 1 ? "" : "s", levels);
}

}  // namespace ehm::monitor
