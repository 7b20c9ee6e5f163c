#include "monitor/engine_table.h"

#include <map>

#include "monitor/design/design_file.h"

namespace ehm::monitor {

EngineTable::EngineTable(const MonitorConfig& config) {
  std::map<std::string, std::shared_ptr<const design::Design>> designs;
  const auto load = [&](const std::string& file) {
    auto& design = designs[file];
    if (!design) design = std::make_shared<const design::Design>(design::read_design(file));
    return design;
  };
  for (const auto& assignment : config.engines) {
    for (const auto id : assignment.ids) {
      slots_.push_back(std::make_unique<EngineSlot>(load(assignment.design), config.cycle));
      slots_.back()->engine_id = static_cast<std::uint32_t>(id);
    }
  }
  if (config.design.empty()) return;
  while (slots_.size() < static_cast<std::size_t>(config.max_engines))
    slots_.push_back(std::make_unique<EngineSlot>(load(config.design), config.cycle));
}

const design::Design* EngineTable::design_of(std::uint32_t engine_id) const noexcept {
  for (const auto& slot : slots_)
    if (slot->engine_id == engine_id || slot->engine_id == 0) return &slot->cycle.design();
  return nullptr;
}

EngineSlot* EngineTable::find(std::uint32_t engine_id, bool may_join) noexcept {
  if (engine_id == 0) return nullptr;  // reserved, see MonitorCommand
  for (auto& slot : slots_) {
    if (slot->engine_id == engine_id) return slot.get();
    if (slot->engine_id == 0) {
      if (!may_join) return nullptr;
      slot->engine_id = engine_id;
      return slot.get();
    }
  }
  return nullptr;
}

}  // namespace ehm::monitor
