// SPDX-License-Identifier: Apache-2.0
#pragma once
// Which estimator takes longer than estimator.budget_ms allows: most_overruns samples in a row, so that one pause of the
// machine is not taken for it. Errors: none. Real-time safe: yes.

#include <array>
#include <cstddef>
#include <cstdint>

#include "monitor/design/make_estimator.h"

namespace ehm::monitor {

class BudgetWatch {
 public:
  static constexpr int most_overruns = 3;

  /// `took_ns`: of that companion, in one more sample. @returns whether it is to rest.
  bool look(std::size_t companion, std::int64_t took_ns, double budget_ms) noexcept {
    int& overruns = overruns_[companion];
    overruns = budget_ms > 0.0 && 1e-6 * static_cast<double>(took_ns) > budget_ms ? overruns + 1 : 0;
    if (overruns < most_overruns) return false;
    overruns = 0;
    return true;
  }

 private:
  std::array<int, design::max_shadows + 1> overruns_{};  ///< samples in a row, by companion
};

}  // namespace ehm::monitor
