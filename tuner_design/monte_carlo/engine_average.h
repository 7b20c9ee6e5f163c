// SPDX-License-Identifier: Apache-2.0
#pragma once
// Mean of some numbers over many engines, with its standard error: s/sqrt(n), s^2 = sum (x - mean)^2/(n - 1).
// Engines are shared by threads in blocks that depend on their number alone; blocks are merged in order (Chan, Golub &
// LeVeque, Am. Stat. 37 (1983) 242), so the result is the same to the bit on any number of threads.

#include <Eigen/Core>
#include <cstddef>
#include <functional>

namespace ehm::tuner_design {

struct EngineAverage {
  Eigen::VectorXd mean, standard_error;
  std::size_t engines = 0;   ///< that counted
  std::size_t left_out = 0;  ///< for which the work had no result
};

/// Fills `numbers` for one engine; false: no result. Depends on the index alone, is called by several threads at once.
using EngineWork = std::function<bool(std::size_t index, Eigen::VectorXd& numbers)>;

/// `size` numbers of each of `engines` engines, 2 or more. `done` is called with the number of engines that are done.
/// @throws what the work throws; std::runtime_error if more than one engine in a hundred has no result.
EngineAverage average_over_engines(std::size_t engines, Eigen::Index size, unsigned threads, const EngineWork& work,
                                   const std::function<void(std::size_t)>& done);

}  // namespace ehm::tuner_design
