// SPDX-License-Identifier: Apache-2.0
#pragma once
// From engine_id to a number, in constant time and in memory that is all there from the start.
//
// Open addressing with linear probing at half load at most; who is removed leaves no gap in the probing of others
// (Knuth, The Art of Computer Programming 3, 6.4, algorithm R). Real-time safe: yes, but for the constructor.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "deploy/runtime/numbers/index.h"

namespace ehm::monitor {

class EngineIndex {
 public:
  explicit EngineIndex(std::size_t capacity);

  static constexpr std::size_t none = as_size(-1);
  /// `engine_id` is not 0. @returns none if it was never added.
  std::size_t find(std::uint32_t engine_id) const noexcept;
  /// `engine_id` is not 0 and not there yet; at most `capacity` are added.
  void add(std::uint32_t engine_id, std::size_t number) noexcept;
  /// Of an id that is there.
  void remove(std::uint32_t engine_id) noexcept;

 private:
  struct Entry {
    std::uint32_t engine_id = 0;  ///< 0: free
    std::size_t number = none;
  };
  /// Where the probing for `engine_id` begins.
  std::size_t home(std::uint32_t engine_id) const noexcept;
  /// Where `engine_id` is, or the free place where it belongs.
  std::size_t place(std::uint32_t engine_id) const noexcept;

  std::vector<Entry> entries_;
};

}  // namespace ehm::monitor
