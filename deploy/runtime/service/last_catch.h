// SPDX-License-Identifier: Apache-2.0
#pragma once
// The last catch of a thread beside the flight: what goes wrong in one of its turns (memory that is short, a disk that
// refuses) is said, and neither ends the process nor the thread.

#include <spdlog/spdlog.h>

#include <exception>

namespace ehm::service {

/// Runs one turn; false if it threw. `thread` names it in the log.
template <class Turn>
bool survive(const char* thread, Turn&& turn) noexcept {
  try {
    turn();
    return true;
  } catch (const std::exception& e) {
    try {
      spdlog::error("{}: {}; it goes on", thread, e.what());
    } catch (...) {  // not even that
    }
  } catch (...) {
  }
  return false;
}

}  // namespace ehm::service
