// SPDX-License-Identifier: Apache-2.0
#pragma once
// A limit that is only round-off beside the error is none: with as many sensors as health parameters nothing but noise
// is left, and endless averaging would take that away.

namespace ehm::tuner_design::report {

inline bool has_limit(double ssee, double limit) {
  return limit > 1e-9 * ssee;
}

}  // namespace ehm::tuner_design::report
