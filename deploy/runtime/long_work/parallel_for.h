// SPDX-License-Identifier: Apache-2.0
#pragma once
// The same work for every index 0 .. count-1, shared by threads: each takes the next index that nobody has. What is
// done for an index must depend on the index alone; then the results are the same on any number of threads.
// Errors: the first exception by index is thrown again after all threads have stopped; later indices may be left out.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace ehm::long_work {

/// One thread a core.
inline unsigned all_cores() {
  return std::max(1u, std::thread::hardware_concurrency());
}

/// `progress` is called with the number of indices done, often, and only by the calling thread, which works too.
template <typename Work>
void parallel_for(
    std::size_t count, unsigned threads, const Work& work,
    const std::function<void(std::size_t)>& progress = [](std::size_t) {}) {
  std::atomic<std::size_t> next{0}, done{0};
  std::mutex guard;
  std::exception_ptr failure;
  std::size_t failed_at = count;
  const auto take_turns = [&](bool reports) {
    for (std::size_t i = 0; (i = next++) < count;) {
      try {
        work(i);
      } catch (...) {
        const std::lock_guard lock(guard);
        if (i < failed_at) failed_at = i, failure = std::current_exception();
        next = count;
      }
      ++done;
      if (reports) progress(done);
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (std::size_t t = 1; t < std::min<std::size_t>(threads, count); ++t)
      helpers.emplace_back([&] { take_turns(false); });
    take_turns(true);
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace ehm::long_work
