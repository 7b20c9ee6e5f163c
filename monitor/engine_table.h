#pragma once
// The engines that this monitor serves. All filters are made at start; an engine that nobody named takes a spare one of
// the default design when its first sample comes, so that the cycle path never allocates.
//
// @throws design::FileError if a design file is bad; std::invalid_argument if an option does not fit a design.

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "monitor/config.h"
#include "monitor/engine_index.h"
#include "monitor/engine_slot.h"

namespace ehm::monitor {

class EngineTable {
 public:
  /// What `before` has prepared of designs with the same hash is shared with it: a reload keeps one copy in memory.
  explicit EngineTable(const MonitorConfig& config, const EngineTable* before = nullptr);

  /// The engine's slot; null for an engine that no design serves or that finds no spare filter. A spare one is given
  /// away only if `may_join`: not for a stray message that cannot be read. Real-time safe: yes.
  EngineSlot* find(std::uint32_t engine_id, bool may_join) noexcept;
  /// Takes over the engines that `old` has in use: those whose design and options are the same with their filter, the
  /// others with their counters, from a cold start. `changed(EngineSlot& old, EngineSlot& now)` is called for each of
  /// the latter. An engine that this table does not serve is left behind. Real-time safe: yes.
  template <class Changed>
  void take_over(EngineTable& old, Changed&& changed) {
    for (std::size_t i = 0; i < old.used_; ++i) {
      const std::uint32_t id = old.slots_[i]->engine_id;
      if (!find(id, true)) continue;
      std::unique_ptr<EngineSlot>& slot = slots_[index_.find(id)];
      if (same_engine(*old.slots_[i], *slot)) {
        slot.swap(old.slots_[i]);
      } else {
        slot->inherit(*old.slots_[i]);
        changed(*old.slots_[i], *slot);
      }
    }
  }
  /// The design that flies, or would fly, for an engine; null if none.
  const design::Design* design_of(std::uint32_t engine_id) const noexcept;
  /// All slots in use.
  template <class Visit>
  void for_each(Visit&& visit) {
    for (std::size_t i = 0; i < used_; ++i) visit(*slots_[i]);
  }
  /// The designs that fly, each once; at least one.
  std::vector<const design::Design*> designs() const;
  std::size_t size() const noexcept { return slots_.size(); }

 private:
  /// By the name of its file.
  using Designs = std::map<std::string, PreparedDesign>;
  static PreparedDesign prepare(const std::string& file, const EngineTable* before);
  static bool same_engine(const EngineSlot& a, const EngineSlot& b) noexcept;
  void assign(std::size_t slot, std::uint32_t engine_id) noexcept;

  Designs designs_;
  std::vector<std::unique_ptr<EngineSlot>> slots_;  // named engines first, then the spare ones
  std::size_t used_ = 0;                            // slots in use
  EngineIndex index_;                               // of those
};

}  // namespace ehm::monitor
