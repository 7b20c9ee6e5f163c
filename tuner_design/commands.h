#pragma once
// The command line of tuner_design: linearise, design, check, evaluate. Exit codes:
//   0 done    1 the data are wrong or a computation failed, the reason is on `err`    2 the command line is wrong

#include <iosfwd>

namespace ehm::bench {

int run_tuner_design(int argc, const char* const* argv, std::ostream& out, std::ostream& err);

}  // namespace ehm::bench
