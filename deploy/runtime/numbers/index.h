// SPDX-License-Identifier: Apache-2.0
#pragma once
// Counts and positions between the two kinds of index that C++ and Eigen use: std::size_t of the standard containers
// and Eigen::Index (std::ptrdiff_t) of matrices. Both take any integer or enumerator; values lie between 0 and 2^31
// everywhere in this project (capacities are fixed, files are limited), so that neither direction loses anything.

#include <Eigen/Core>
#include <concepts>
#include <cstddef>
#include <type_traits>

namespace ehm {

template <typename T>
concept Countable = std::integral<T> || std::is_enum_v<T>;

/// For a[as_size(i)] of a std::vector or std::array.
constexpr std::size_t as_size(Countable auto value) noexcept {
  return static_cast<std::size_t>(value);
}

/// For m(as_index(i), j) of a matrix, and for its sizes.
constexpr Eigen::Index as_index(Countable auto value) noexcept {
  return static_cast<Eigen::Index>(value);
}

}  // namespace ehm
