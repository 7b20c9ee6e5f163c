// SPDX-License-Identifier: Apache-2.0
#pragma once
// The engines that this monitor serves. All filters are made at start; an engine that nobody named takes a spare one of
// the default design when its first usable sample comes, so that the cycle path never allocates, and gives it back when
// it has been silent for long.
//
// @throws files::FileError if a design file is bad; std::invalid_argument if an option does not fit a design.

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "monitor/shared/engine_index.h"
#include "monitor/shared/engine_slot.h"
#include "monitor/shared/monitor_config.h"

namespace ehm::monitor {

class EngineTable {
 public:
  /// What `before` has prepared of designs with the same hash is shared with it: a reload keeps one copy in memory.
  explicit EngineTable(const MonitorConfig& config, const EngineTable* before = nullptr);

  /// The engine's slot; null for one that has none. Real-time safe: yes.
  EngineSlot* find(std::uint32_t engine_id) noexcept;
  /// Gives a spare filter to an engine that has none; null where there is none left. Real-time safe: yes.
  EngineSlot* join(std::uint32_t engine_id) noexcept;
  /// The same, and null if this first sample is of no use: a stray message must not take a filter. Real-time safe: yes.
  EngineSlot* join(std::uint32_t engine_id, const Sample& first) noexcept;
  /// The filter that the next engine would get; null where there is none. Real-time safe: yes.
  const EngineSlot* spare() const noexcept;
  /// Is this the slot of an engine that nobody named, so that it may leave?
  bool may_leave(const EngineSlot& slot) const noexcept { return slot.number >= named_; }
  /// Takes the filter back, as it was at start. Real-time safe: yes.
  void leave(EngineSlot& slot) noexcept;
  /// Takes over the engines that `old` has in use: those whose design and options are the same with their filter, the
  /// others with their counters, from a cold start. `changed(EngineSlot& old, EngineSlot& now)` is called for each of
  /// the latter. An engine that this table does not serve is left behind. Real-time safe: yes.
  template <class Changed>
  void take_over(EngineTable& old, Changed&& changed) {
    for (std::unique_ptr<EngineSlot>& before : old.slots_) {
      const std::uint32_t id = before->engine_id;
      if (id == 0 || (!find(id) && !join(id))) continue;
      const std::size_t number = index_.find(id);
      std::unique_ptr<EngineSlot>& now = slots_[number];
      if (same_engine(*before, *now)) {
        now.swap(before);
        now->number = number;
      } else {
        now->inherit(*before);
        changed(*before, *now);
      }
    }
  }
  /// The design that flies, or would fly, for an engine; null if none.
  const design::Design* design_of(std::uint32_t engine_id) const noexcept;
  /// All slots in use.
  template <class Visit>
  void for_each(Visit&& visit) {
    for (const auto& slot : slots_)
      if (slot->engine_id != 0) visit(*slot);
  }
  /// The designs that fly, each once; at least one.
  std::vector<const design::Design*> designs() const;
  std::size_t size() const noexcept { return slots_.size(); }
  /// Of all engines, in the order of their topics.
  const std::vector<std::string>& shadows() const noexcept { return shadows_; }

 private:
  using Flown = std::array<std::string, 3>;  ///< file, published and shadow estimators
  using Designs = std::map<Flown, PreparedDesign>;
  static PreparedDesign prepare(const std::string& file, const CycleOptions& options, const EngineTable* before);
  static bool same_engine(const EngineSlot& a, const EngineSlot& b) noexcept;
  void assign(EngineSlot& slot, std::uint32_t engine_id) noexcept;

  Designs designs_;
  std::vector<std::string> shadows_;
  std::vector<std::unique_ptr<EngineSlot>> slots_;  ///< of engines that were named first, then those for others
  std::size_t named_ = 0, free_ = 0;                ///< of all slots
  std::unique_ptr<const MonitorCycle> pristine_;    ///< of the others' design; null where there is none
  EngineIndex index_;                               ///< of the slots in use
};

}  // namespace ehm::monitor
