// SPDX-License-Identifier: Apache-2.0
#pragma once
// Exit codes of every program of the project; --help repeats them.

namespace ehm::service {

enum ExitCode : int {
  exit_ok = 0,
  exit_failed = 1,  ///< it ran and something went wrong; the last message says what
  exit_usage = 2    ///< the command line, configuration or an input file is wrong; nothing was started
};

inline constexpr const char* exit_code_help =
    "Exit codes: 0 done, 1 failed while running, 2 wrong command line, configuration or input file.";

}  // namespace ehm::service
