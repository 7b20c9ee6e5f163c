// SPDX-License-Identifier: Apache-2.0
#pragma once
// A performance deck: every case solved from a cold start, so that a row depends on nothing but its own inputs and the
// bytes are the same on any number of threads. A case without a steady point is a row with converged = 0 and empty
// cells, and its reason goes to who asked. Numbers are the shortest that read back as the same double.

#include <functional>
#include <string>
#include <string_view>

#include "engine_sim/deck/deck_cases.h"

namespace ehm::engine_sim {

/// Where the deck goes, and what may stop it. `write` and `failed` are called in the order of the rows, `progress`
/// often, all by the thread that called write_deck(); `stopped` by every thread.
struct DeckSink {
  std::function<void(std::string_view)> write;
  std::function<void(const DeckCase&, const std::string& reason)> failed;
  std::function<void(std::size_t cases_done)> progress = [](std::size_t) {};
  std::function<bool()> stopped = [] { return false; };
};

struct DeckSummary {
  std::size_t cases = 0;
  std::size_t not_converged = 0;
  std::size_t beyond_surge = 0;    ///< converged, with a negative stall margin
  std::size_t beyond_ratings = 0;  ///< converged, above maximum power (ratings.h)
  long newton_iterations = 0;      ///< of the converged cases
};

/// The column names, with what is an input not repeated among the outputs.
std::string deck_header(const DeckCases& cases);

/// Header and rows. `threads`: one or more.
/// @throws std::runtime_error if stopped; whatever `write` throws
DeckSummary write_deck(const Turbofan& engine, const DeckCases& cases, unsigned threads, const DeckSink& sink);

}  // namespace ehm::engine_sim
