#include "monitor/engine_index.h"

#include <bit>

namespace ehm::monitor {

EngineIndex::EngineIndex(std::size_t capacity) : entries_(std::bit_ceil(2 * capacity + 1)) {}

std::size_t EngineIndex::place(std::uint32_t engine_id) const noexcept {
  // Knuth's multiplicative hash: 2^32 / golden ratio; ids of a fleet are often consecutive.
  constexpr std::uint32_t golden = 2654435769u;
  const std::size_t mask = entries_.size() - 1;
  std::size_t i = (engine_id * golden) & mask;
  while (entries_[i].engine_id != 0 && entries_[i].engine_id != engine_id) i = (i + 1) & mask;
  return i;
}

std::size_t EngineIndex::find(std::uint32_t engine_id) const noexcept {
  return entries_[place(engine_id)].number;
}

void EngineIndex::add(std::uint32_t engine_id, std::size_t number) noexcept {
  entries_[place(engine_id)] = {engine_id, number};
}

}  // namespace ehm::monitor
