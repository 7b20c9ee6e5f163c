// SPDX-License-Identifier: Apache-2.0
#pragma once
// A filter does not exist, or a solver could not compute it: the Riccati or Lyapunov equation has no solution, the
// closed loop is unstable, an accuracy is missed. What tries several tuners may go on to others; every other error is
// a mistake and goes through.

#include <stdexcept>

namespace ehm::estimation {

class SolverError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace ehm::estimation
