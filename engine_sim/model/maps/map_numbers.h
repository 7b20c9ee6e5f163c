// SPDX-License-Identifier: Apache-2.0
#pragma once
// The numbers of a map in one store of its own: spans into a caller's arrays become spans into the store, which copies
// of the map share. Errors: none.

#include <initializer_list>
#include <memory>
#include <span>
#include <vector>

namespace ehm::engine_sim {

using MapNumbers = std::shared_ptr<const std::vector<double>>;

/// Copies what the spans show and points them at the copy, which lives as long as the result is held.
inline MapNumbers own_numbers(std::initializer_list<std::span<const double>*> spans) {
  std::size_t size = 0;
  for (const auto* span : spans) size += span->size();
  const auto store = std::make_shared<std::vector<double>>();
  store->reserve(size);  // never moved while it is filled
  for (auto* span : spans) {
    const double* const first = store->data() + store->size();
    store->insert(store->end(), span->begin(), span->end());
    *span = {first, span->size()};
  }
  return store;
}

}  // namespace ehm::engine_sim
