// SPDX-License-Identifier: Apache-2.0
#include "monitor/shared/engine_table.h"

#include <algorithm>
#include <stdexcept>

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/numbers/index.h"
#include "monitor/design/design_file.h"
#include "monitor/design/option_error.h"
#include "monitor/shared/engine_estimators.h"

namespace ehm::monitor {

PreparedDesign EngineTable::prepare(const std::string& file, const CycleOptions& options, const EngineTable* before) {
  auto design = std::make_shared<const design::Design>(design::read_design(file));
  if (before)
    for (const auto& [flown, prepared] : before->designs_)
      if (prepared.design->hash == design->hash && prepared.serves(options)) return prepared;
  try {
    return PreparedDesign(std::move(design), options);
  } catch (const design::OptionError& e) {
    throw files::FileError(file + ": " + e.what());
  } catch (const std::invalid_argument& e) {
    throw files::FileError(file + ": the matrices do not fit together: " + e.what() +
                           ". Make the design again with tuner_design design.");
  }
}

EngineTable::EngineTable(const MonitorConfig& config, const EngineTable* before)
    : shadows_(all_shadow_names(config)), index_(as_size(config.max_engines)) {
  const auto make_slot = [&](const std::string& file, const CycleOptions& options) {
    const Flown flown{file, options.estimator.published, options.estimator.shadow};
    auto known = designs_.find(flown);
    if (known == designs_.end()) known = designs_.emplace(flown, prepare(file, options, before)).first;
    auto slot = std::make_unique<EngineSlot>(known->second, options, shadow_places(options.estimator, shadows_));
    slot->number = slots_.size();
    return slot;
  };
  for (const auto& assignment : config.engines)
    for (const auto id : assignment.ids) {
      slots_.push_back(make_slot(assignment.design, options_of(config, assignment)));
      assign(*slots_.back(), static_cast<std::uint32_t>(id));
    }
  named_ = slots_.size();
  if (config.design.empty()) return;
  while (slots_.size() < as_size(config.max_engines)) slots_.push_back(make_slot(config.design, config.cycle));
  free_ = slots_.size() - named_;
  if (free_ > 0) pristine_ = std::make_unique<const MonitorCycle>(slots_.back()->cycle);
}

std::vector<const design::Design*> EngineTable::designs() const {
  std::vector<const design::Design*> designs;
  for (const auto& slot : slots_)
    if (std::find(designs.begin(), designs.end(), &slot->cycle.design()) == designs.end())
      designs.push_back(&slot->cycle.design());
  return designs;
}

const design::Design* EngineTable::design_of(std::uint32_t engine_id) const noexcept {
  for (const auto& slot : slots_)
    if (slot->engine_id == engine_id || slot->engine_id == 0) return &slot->cycle.design();
  return nullptr;
}

EngineSlot* EngineTable::find(std::uint32_t engine_id) noexcept {
  if (engine_id == 0) return nullptr;  // reserved, see MonitorCommand
  const std::size_t i = index_.find(engine_id);
  return i == EngineIndex::none ? nullptr : slots_[i].get();
}

const EngineSlot* EngineTable::spare() const noexcept {
  if (free_ == 0) return nullptr;
  const auto others = slots_.begin() + static_cast<std::ptrdiff_t>(named_);
  const auto free = std::find_if(others, slots_.end(), [](const auto& slot) { return slot->engine_id == 0; });
  return free->get();
}

EngineSlot* EngineTable::join(std::uint32_t engine_id, const Sample& first) noexcept {
  const EngineSlot* free = spare();
  return free && free->cycle.usable(first) ? join(engine_id) : nullptr;
}

EngineSlot* EngineTable::join(std::uint32_t engine_id) noexcept {
  const EngineSlot* free = engine_id == 0 ? nullptr : spare();
  if (!free) return nullptr;
  --free_;
  assign(*slots_[free->number], engine_id);
  return slots_[free->number].get();
}

void EngineTable::leave(EngineSlot& slot) noexcept {
  index_.remove(slot.engine_id);
  slot.vacate(*pristine_);
  ++free_;
}

bool EngineTable::same_engine(const EngineSlot& a, const EngineSlot& b) noexcept {
  return a.cycle.design().hash == b.cycle.design().hash && a.cycle.options() == b.cycle.options();
}

void EngineTable::assign(EngineSlot& slot, std::uint32_t engine_id) noexcept {
  slot.engine_id = engine_id;
  index_.add(engine_id, slot.number);
}

}  // namespace ehm::monitor
