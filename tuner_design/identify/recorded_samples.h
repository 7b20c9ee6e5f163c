// SPDX-License-Identifier: Apache-2.0
#pragma once
// A recording of one engine as the identification sees it: N samples, one column each, channel units of the model.
// A value that is missing (not valid, not a number) is NaN.

#include <Eigen/Core>
#include <vector>

namespace ehm::tuner_design {

struct RecordedSamples {
  Eigen::MatrixXd flight;               ///< 3 x N: altitude_m, mach, delta_isa_k
  Eigen::MatrixXd controls;             ///< nu x N
  Eigen::MatrixXd sensors;              ///< m x N
  std::vector<Eigen::Index> gap_after;  ///< columns that the next one does not follow by one sample time, ascending
};

/// Columns begin .. begin + length - 1.
struct Span {
  Eigen::Index begin = 0, length = 0;
};

}  // namespace ehm::tuner_design
