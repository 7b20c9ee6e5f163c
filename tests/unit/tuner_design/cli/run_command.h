// SPDX-License-Identifier: Apache-2.0
#pragma once
// One run of the command line of tuner_design inside a test.

#include <sstream>
#include <string>
#include <vector>

#include "tuner_design/cli/commands.h"

namespace ehm::test {

struct CommandResult {
  int code;
  std::string out, err;
};

inline CommandResult run_command(const std::vector<std::string>& arguments) {
  std::vector<const char*> argv{"tuner_design"};
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  std::ostringstream out, err;
  const int code = tuner_design::run_tuner_design(static_cast<int>(argv.size()), argv.data(), out, err);
  return {code, out.str(), err.str()};
}

}  // namespace ehm::test
