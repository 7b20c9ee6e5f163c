#include "monitor/engine_table.h"

#include <map>

#include "monitor/design/design_file.h"

namespace ehm::monitor {

EngineTable::EngineTable(const MonitorConfig& config) {
  struct Loaded {
    std::shared_ptr<const design::Design> design;
    std::shared_ptr<const FaultTables> faults;
  };
  std::map<std::string, Loaded> designs;
  const auto slot = [&](const std::string& file) {
    Loaded& loaded = designs[file];
    if (!loaded.design) {
      loaded.design = std::make_shared<const design::Design>(design::read_design(file));
      loaded.faults = fault_tables(*loaded.design);
    }
    return std::make_unique<EngineSlot>(loaded.design, config.cycle, loaded.faults);
  };
  for (const auto& assignment : config.engines) {
    for (const auto id : assignment.ids) {
      slots_.push_back(slot(assignment.design));
      slots_.back()->engine_id = static_cast<std::uint32_t>(id);
    }
  }
  if (config.design.empty()) return;
  while (slots_.size() < static_cast<std::size_t>(config.max_engines)) slots_.push_back(slot(config.design));
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
