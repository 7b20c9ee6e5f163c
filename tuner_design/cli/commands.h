// SPDX-License-Identifier: Apache-2.0
#pragma once
// The command line of tuner_design; `--help` lists the commands. Exit codes:
//   0 done    1 a computation failed    2 the command line or an input file is wrong; the reason is on `err`

#include <iosfwd>

namespace ehm::tuner_design {

int run_tuner_design(int argc, const char* const* argv, std::ostream& out, std::ostream& err);

}  // namespace ehm::tuner_design
