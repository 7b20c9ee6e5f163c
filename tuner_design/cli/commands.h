// SPDX-License-Identifier: Apache-2.0
#pragma once
// The command line of tuner_design; `--help` lists the commands. Exit codes:
//   0 done    1 the data are wrong or a computation failed, the reason is on `err`    2 the command line is wrong

#include <iosfwd>

namespace ehm::tuner_design {

int run_tuner_design(int argc, const char* const* argv, std::ostream& out, std::ostream& err);

}  // namespace ehm::tuner_design
