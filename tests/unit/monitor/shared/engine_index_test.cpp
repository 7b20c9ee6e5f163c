// SPDX-License-Identifier: Apache-2.0
#include "monitor/shared/engine_index.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace {

using ehm::monitor::EngineIndex;

TEST(EngineIndex, FindsWhatWasAddedAndNothingElse) {
  constexpr std::uint32_t engines = 1000;
  EngineIndex index(engines);
  const auto id = [](std::uint32_t i) { return i % 2 == 0 ? i + 1 : 4294967295u - i; };  // near both ends of the range
  for (std::uint32_t i = 0; i < engines; ++i) {
    EXPECT_EQ(index.find(id(i)), EngineIndex::none);
    index.add(id(i), i);
  }
  for (std::uint32_t i = 0; i < engines; ++i) EXPECT_EQ(index.find(id(i)), i);
  EXPECT_EQ(index.find(500'000), EngineIndex::none);
}

TEST(EngineIndex, IdsThatCollideStayApart) {
  EngineIndex index(3);  // 8 places: ids 8 apart share one
  index.add(8, 0);
  index.add(16, 1);
  index.add(24, 2);
  EXPECT_EQ(index.find(8), 0u);
  EXPECT_EQ(index.find(16), 1u);
  EXPECT_EQ(index.find(24), 2u);
  EXPECT_EQ(index.find(32), EngineIndex::none);
}

// Against std::map: ten thousand random steps in a table that is always nearly as full as it may be.
TEST(EngineIndex, WhoIsRemovedLeavesEverybodyElseFindable) {
  constexpr std::size_t capacity = 100;
  EngineIndex index(capacity);
  std::map<std::uint32_t, std::size_t> truth;
  std::mt19937 random(5);
  for (std::size_t step = 0; step < 10'000; ++step) {
    const std::uint32_t id = 1 + random() % 160;
    if (truth.contains(id)) {
      index.remove(id);
      truth.erase(id);
    } else if (truth.size() < capacity) {
      index.add(id, step);
      truth[id] = step;
    }
    for (std::uint32_t i = 1; i <= 160; ++i)
      ASSERT_EQ(index.find(i), truth.contains(i) ? truth[i] : EngineIndex::none) << step << ' ' << i;
  }
}

TEST(EngineIndex, OfNothingFindsNothing) {
  EXPECT_EQ(EngineIndex(0).find(1), EngineIndex::none);
}

}  // namespace
