#pragma once
// From engine_id to a number, in constant time and in memory that is all there from the start.
//
// Open addressing with linear probing at half load at most; nothing is ever removed. Real-time safe: yes, but for the
// constructor.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ehm::monitor {

class EngineIndex {
 public:
  explicit EngineIndex(std::size_t capacity);

  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  /// `engine_id` is not 0. @returns none if it was never added.
  std::size_t find(std::uint32_t engine_id) const noexcept;
  /// `engine_id` is not 0 and not there yet; at most `capacity` are added.
  void add(std::uint32_t engine_id, std::size_t number) noexcept;

 private:
  struct Entry {
    std::uint32_t engine_id = 0;  ///< 0: free
    std::size_t number = none;
  };
  /// Where `engine_id` is, or the free place where it belongs.
  std::size_t place(std::uint32_t engine_id) const noexcept;

  std::vector<Entry> entries_;
};

}  // namespace ehm::monitor
