// SPDX-License-Identifier: Apache-2.0
#pragma once
// engine_sim's offline commands within the test process.

#include <sstream>
#include <string>
#include <vector>

#include "engine_sim/commands.h"

namespace ehm::test {

struct Result {
  int code;  ///< -1: the service's own command line
  std::string out, err;
};

inline Result run_engine_sim(const std::vector<std::string>& arguments) {
  std::vector<const char*> argv{"engine_sim"};
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  std::ostringstream out, err;
  const auto code = engine_sim::run_command(static_cast<int>(argv.size()), argv.data(), out, err);
  return {code.value_or(-1), out.str(), err.str()};
}

}  // namespace ehm::test
