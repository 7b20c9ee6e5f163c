// SPDX-License-Identifier: Apache-2.0
#pragma once
// Reads values off the fuzzer's bytes; zeros where they end.

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>

namespace ehm::fuzz {

class ByteReader {
 public:
  ByteReader(const std::uint8_t* data, std::size_t size) : left_(data, size) {}
  bool empty() const { return left_.empty(); }
  template <class T>
  T take() {
    T value{};
    const std::size_t size = std::min(sizeof value, left_.size());
    std::memcpy(&value, left_.data(), size);
    left_ = left_.subspan(size);
    return value;
  }
  std::span<const std::uint8_t> rest(std::size_t most) {
    const auto piece = left_.first(std::min(most, left_.size()));
    left_ = left_.subspan(piece.size());
    return piece;
  }

 private:
  std::span<const std::uint8_t> left_;
};

}  // namespace ehm::fuzz
