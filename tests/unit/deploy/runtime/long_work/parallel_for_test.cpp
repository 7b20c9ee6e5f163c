// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/long_work/parallel_for.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace ehm::long_work {
namespace {

TEST(ParallelFor, DoesEveryIndexOnceAndReportsFromTheCallingThread) {
  for (const unsigned threads : {1U, 2U, 7U}) {
    std::vector<std::atomic<int>> times(1000);
    const auto caller = std::this_thread::get_id();
    std::size_t last = 0;
    parallel_for(
        times.size(), threads, [&](std::size_t i) { ++times[i]; },
        [&](std::size_t done) {
          EXPECT_EQ(std::this_thread::get_id(), caller);
          EXPECT_GE(done, last);
          last = done;
        });
    for (const auto& count : times) ASSERT_EQ(count, 1);
    EXPECT_LE(last, times.size());
  }
}

TEST(ParallelFor, ThrowsTheFirstExceptionByIndex) {
  const auto work = [](std::size_t i) {
    if (i == 3 || i == 900) throw std::runtime_error("index " + std::to_string(i));
  };
  for (const unsigned threads : {1U, 4U}) {
    try {
      parallel_for(1000, threads, work);
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "index 3");
    }
  }
}

TEST(ParallelFor, NothingToDo) {
  parallel_for(0, 4, [](std::size_t) { FAIL(); });
}

}  // namespace
}  // namespace ehm::long_work
