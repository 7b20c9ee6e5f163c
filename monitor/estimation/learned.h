// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a flight leaves to the next one of the same engine, the baseline that its wear is counted from: constants of the
// engine, and how well they are known together. Their meaning and order are the estimator's; health, in percent, comes
// first. Of length 0: nothing is kept. Plain data of fixed capacity: a copy allocates nothing.

#include "monitor/estimation/capacity.h"

namespace ehm::estimation {

inline constexpr int max_learned = 2 * max_health;

struct Learned {
  BoundedVector<max_learned> value;
  BoundedMatrix<max_learned, max_learned> covariance;
  bool empty() const noexcept { return value.size() == 0; }
};

}  // namespace ehm::estimation
