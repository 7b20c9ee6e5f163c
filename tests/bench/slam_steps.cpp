// SPDX-License-Identifier: Apache-2.0
// Flies the slams of slam_flight.h once and prints the number of steps: what instructions.sh counts under callgrind.

#include <cstdio>

#include "engine_sim/engines/jt9d.h"
#include "tests/bench/slam_flight.h"

int main() {
  using namespace ehm::engine_sim;
  const Turbofan engine(jt9d());
  SlamFlight flight(engine);
  double t40_max_k = 0.0;
  for (std::size_t k = 0; k < SlamFlight::steps_of_all; ++k) {
    flight.prepare();
    t40_max_k = std::max(t40_max_k, flight.step());
  }
  std::printf("%zu steps, hottest T40 %.1f K\n", SlamFlight::steps_of_all, t40_max_k);
}
