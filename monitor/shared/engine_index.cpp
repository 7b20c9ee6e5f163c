// SPDX-License-Identifier: Apache-2.0
#include "monitor/shared/engine_index.h"

#include <bit>

namespace ehm::monitor {

EngineIndex::EngineIndex(std::size_t capacity) : entries_(std::bit_ceil(2 * capacity + 1)) {}

std::size_t EngineIndex::home(std::uint32_t engine_id) const noexcept {
  // Knuth's multiplicative hash: 2^32 / golden ratio; ids of a fleet are often consecutive.
  constexpr std::uint32_t golden = 2654435769u;
  return (engine_id * golden) & (entries_.size() - 1);
}

std::size_t EngineIndex::place(std::uint32_t engine_id) const noexcept {
  const std::size_t mask = entries_.size() - 1;
  std::size_t i = home(engine_id);
  while (entries_[i].engine_id != 0 && entries_[i].engine_id != engine_id) i = (i + 1) & mask;
  return i;
}

std::size_t EngineIndex::find(std::uint32_t engine_id) const noexcept {
  return entries_[place(engine_id)].number;
}

void EngineIndex::add(std::uint32_t engine_id, std::size_t number) noexcept {
  entries_[place(engine_id)] = {engine_id, number};
}

void EngineIndex::remove(std::uint32_t engine_id) noexcept {
  const std::size_t mask = entries_.size() - 1;
  std::size_t gap = place(engine_id);
  for (std::size_t i = (gap + 1) & mask; entries_[i].engine_id != 0; i = (i + 1) & mask) {
    // Whoever would not be found any more beyond the gap moves into it.
    if (((i - home(entries_[i].engine_id)) & mask) < ((i - gap) & mask)) continue;
    entries_[gap] = entries_[i];
    gap = i;
  }
  entries_[gap] = {};
}

}  // namespace ehm::monitor
